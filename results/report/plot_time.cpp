#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "results/report/plot_parts.h"
#include "results/statistics/mser.h"

namespace results::report {
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

std::vector<double> equidistant(double from, double to) {
  std::vector<double> times;
  for (std::size_t i = 0; i < kTimes && from <= to; ++i) {
    times.push_back(from + (to - from) * static_cast<double>(i) / (kTimes - 1));
  }
  return times;
}

/// Whether these are samples of one period. A single time has none.
bool is_periodic(const std::vector<double>& times) {
  if (times.size() < 2) return false;
  const double period = times[1] - times[0];
  for (std::size_t i = 2; i < times.size(); ++i) {
    if (std::abs(times[i] - times[i - 1] - period) > 1e-6 * period) return false;
  }
  return true;
}

/// Of all courses if they are equal, and the end if the last value held until then; else
/// equidistant ones over the time that all of them cover.
/// @param end  s, of the run that ended first; 0: not known.
std::vector<double> common_times(const std::vector<const Course*>& courses, double end) {
  std::vector<double> times = times_of(*courses.front());
  double from = times.front();
  double to = std::max(times.back(), end);
  bool is_equal = true;
  for (const Course* course : courses) {
    is_equal = is_equal && times_of(*course) == times;
    from = std::max(from, course->front().first);
    to = std::min(to, std::max(course->back().first, end));
  }
  if (!is_equal) return equidistant(from, to);
  const bool is_last_sample = is_periodic(times) && to - times.back() <= times[1] - times[0];
  if (to > times.back() && !is_last_sample) times.push_back(to);
  return times;
}

/// When the first of these runs ended [s]; 0: it is not known of all.
double end_of(const Experiment& experiment, const std::vector<std::size_t>& runs) {
  const auto ends = experiment.values.find({"run.simulated", ""});
  if (ends == experiment.values.end()) return 0;
  double end = std::numeric_limits<double>::infinity();
  for (const std::size_t run : runs) {
    const auto found = ends->second.find(run);
    if (found == ends->second.end()) return 0;
    end = std::min(end, found->second);
  }
  return std::isfinite(end) ? end : 0;
}

/// The latest sample until then: a value holds until the next. @pre there is one.
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
                     const std::vector<const std::vector<Course>*>& runs, const Plot& plot) {
  Plot::Curve curve{label, {}};
  for (const double time : times) {
    Sample sample{{}, {plot.support, {}}};
    sample.values.reserve(runs.size());
    for (const std::vector<Course>* agents : runs) sample.values.push_back(mean_at(*agents, time));
    Plot::Mark& mark = curve.marks.emplace_back(mark_of(sample, plot.interval));
    mark.x = time;
  }
  return curve;
}

/// MSER-5 takes values of equal weight: of a course that was recorded on change, those that held
/// at equidistant times.
void note_warm_up(Plot& plot, const Plot::Curve& curve) {
  Course course;
  for (const Plot::Mark& mark : curve.marks) course.emplace_back(mark.x, mark.y);
  std::vector<double> times = times_of(course);
  if (times.size() < 2) return;
  if (!is_periodic(times)) times = equidistant(times.front(), times.back());
  if (times.size() < kEnoughForWarmUp) return;
  std::vector<double> means;
  means.reserve(times.size());
  for (const double time : times) means.push_back(value_at(course, time));
  const auto warm_up = statistics::mser(means);
  if (!warm_up) return;
  plot.notes.push_back(
      warm_up->is_too_short
          ? fmt::format("{}: has not settled by MSER-5; run it for longer", curve.label)
          : fmt::format("{}: warm-up by MSER-5 until {:g} s", curve.label, times[warm_up->values]));
}

}  // namespace

std::map<std::size_t, std::vector<Experiment::Course>> courses_of(
    const Experiment& experiment, const sim::scenario::PlotRequest& request) {
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

void add_time(Plot& plot, const Experiment& experiment, const sim::scenario::PlotRequest& request) {
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
    std::vector<std::size_t> places;
    for (const std::size_t run : experiment.points[i].runs) {
      const auto found = courses.find(run);
      if (found == courses.end()) continue;
      runs.push_back(&found->second);
      places.push_back(run);
      for (const Course& course : found->second) all.push_back(&course);
    }
    if (runs.empty()) continue;
    plot.curves.push_back(
        curve_of(experiment.label(i), common_times(all, end_of(experiment, places)), runs, plot));
    note_warm_up(plot, plot.curves.back());
  }
}

}  // namespace results::report
