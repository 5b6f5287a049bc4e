#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "sim/report/plot_parts.h"
#include "sim/statistics/mser.h"

namespace sim::report {
namespace {

using Course = Experiment::Course;

/// Times at which courses are read that were not sampled at the same ones.
constexpr std::size_t kTimes = 200;
/// Series shorter than this say nothing about a warm-up: fewer than ten batches of five.
constexpr std::size_t kEnoughForWarmUp = 50;

std::vector<double> times_of(const Course& course) {
  std::vector<double> times;
  for (const auto& [at, value] : course) times.push_back(at);
  return times;
}

/// Of all courses if they are equal; else equidistant ones over the time that all of them cover.
std::vector<double> common_times(const std::vector<const Course*>& courses) {
  std::vector<double> times = times_of(*courses.front());
  double from = times.front();
  double to = times.back();
  bool is_equal = true;
  for (const Course* course : courses) {
    is_equal = is_equal && times_of(*course) == times;
    from = std::max(from, course->front().first);
    to = std::min(to, course->back().first);
  }
  if (is_equal) return times;
  times.clear();
  for (std::size_t i = 0; i < kTimes && from <= to; ++i) {
    times.push_back(from + (to - from) * static_cast<double>(i) / (kTimes - 1));
  }
  return times;
}

/// The latest sample until then. @pre there is one.
double value_at(const Course& course, double time) {
  const auto after = std::ranges::upper_bound(course, time, {}, &Course::value_type::first);
  return std::prev(after)->second;
}

double mean_at(const std::vector<Course>& agents, double time) {
  double sum = 0;
  for (const Course& course : agents) sum += value_at(course, time);
  return sum / static_cast<double>(agents.size());
}

Plot::Curve curve_of(const std::string& label, const std::vector<double>& times,
                     const std::vector<const std::vector<Course>*>& runs, IntervalKind interval) {
  Plot::Curve curve{label, {}};
  for (const double time : times) {
    std::vector<double> values;
    values.reserve(runs.size());
    for (const std::vector<Course>* agents : runs) values.push_back(mean_at(*agents, time));
    Plot::Mark& mark = curve.marks.emplace_back(mark_of(values, interval));
    mark.x = time;
  }
  return curve;
}

void note_warm_up(Plot& plot, const Plot::Curve& curve) {
  if (curve.marks.size() < kEnoughForWarmUp) return;
  std::vector<double> means;
  for (const Plot::Mark& mark : curve.marks) means.push_back(mark.y);
  const auto warm_up = statistics::mser(means);
  if (!warm_up) return;
  plot.notes.push_back(
      warm_up->is_too_short
          ? fmt::format("{}: has not settled by MSER-5; run it for longer", curve.label)
          : fmt::format("{}: warm-up by MSER-5 until {:g} s", curve.label,
                        curve.marks[warm_up->values].x));
}

}  // namespace

std::map<std::size_t, std::vector<Experiment::Course>> courses_of(const Experiment& experiment,
                                                                  const PlotRequest& request) {
  std::map<std::size_t, std::vector<Course>> found;
  const auto add = [&](const Experiment::Quantity& quantity) {
    const auto by_run = experiment.courses.find(quantity);
    if (by_run == experiment.courses.end()) return;
    for (const auto& [run, course] : by_run->second) {
      if (!course.empty()) found[run].push_back(course);
    }
  };
  add({request.plot, request.agent});
  if (!found.empty() || !request.agent.empty()) return found;
  for (const auto& [quantity, by_run] : experiment.courses) {
    if (quantity.name == request.plot) add(quantity);
  }
  return found;
}

void add_time(Plot& plot, const Experiment& experiment, const PlotRequest& request) {
  const auto courses = courses_of(experiment, request);
  if (courses.empty()) {
    throw std::runtime_error(fmt::format(
        "{}: was not recorded over time; `record: {{observables: …}}` of the scenario does that",
        request.plot));
  }
  plot.x_label = "simulated time / s";
  for (std::size_t i = 0; i < experiment.points.size(); ++i) {
    std::vector<const std::vector<Course>*> runs;
    std::vector<const Course*> all;
    for (const std::size_t run : experiment.points[i].runs) {
      const auto found = courses.find(run);
      if (found == courses.end()) continue;
      runs.push_back(&found->second);
      for (const Course& course : found->second) all.push_back(&course);
    }
    if (runs.empty()) continue;
    plot.curves.push_back(curve_of(experiment.label(i), common_times(all), runs, plot.interval));
    note_warm_up(plot, plot.curves.back());
  }
}

}  // namespace sim::report
