#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "results/report/plot_parts.h"
#include "results/statistics/mser.h"

namespace results::report {
namespace {

using TimeSeries = Experiment::TimeSeries;

/// Number of times at which series are read that were sampled at different times.
constexpr std::size_t kTimes = 200;
/// Series with fewer values than this (ten batches of five) say nothing about a warm-up.
constexpr std::size_t kEnoughForWarmUp = 50;

std::vector<double> times_of(const TimeSeries& series) {
  std::vector<double> times;
  for (const auto& [at, value] : series) times.push_back(at);
  return times;
}

std::vector<double> equidistant(double from, double to) {
  std::vector<double> times;
  for (std::size_t i = 0; i < kTimes && from <= to; ++i) {
    times.push_back(from + (to - from) * static_cast<double>(i) / (kTimes - 1));
  }
  return times;
}

/// Whether the times are equidistant. A single time is not.
bool is_periodic(const std::vector<double>& times) {
  if (times.size() < 2) return false;
  const double period = times[1] - times[0];
  for (std::size_t i = 2; i < times.size(); ++i) {
    if (std::abs(times[i] - times[i - 1] - period) > 1e-6 * period) return false;
  }
  return true;
}

/// Times at which to read all series. If all were sampled at the same times, these, and the end if
/// the last value was held until then; otherwise equidistant times over the interval that all
/// cover.
/// @param end  s, end of the run that ended first; 0: not known.
std::vector<double> common_times(const std::vector<const TimeSeries*>& all, double end) {
  std::vector<double> times = times_of(*all.front());
  double from = times.front();
  double to = std::max(times.back(), end);
  bool is_equal = true;
  for (const TimeSeries* series : all) {
    is_equal = is_equal && times_of(*series) == times;
    from = std::max(from, series->front().first);
    to = std::min(to, std::max(series->back().first, end));
  }
  if (!is_equal) return equidistant(from, to);
  const bool is_last_sample = is_periodic(times) && to - times.back() <= times[1] - times[0];
  if (to > times.back() && !is_last_sample) times.push_back(to);
  return times;
}

/// Earliest end of these runs [s]; 0: the end of at least one is not known.
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

/// The latest sample at or before `time`: a value holds until the next. @pre There is one.
double value_at(const TimeSeries& series, double time) {
  const auto after = std::ranges::upper_bound(series, time, {}, &TimeSeries::value_type::first);
  return std::prev(after)->second;
}

double mean_at(const std::vector<TimeSeries>& agents, double time) {
  double sum = 0;
  for (const TimeSeries& series : agents) sum += value_at(series, time);
  return sum / static_cast<double>(agents.size());
}

Plot::Curve curve_of(const std::string& label, const std::vector<double>& times,
                     const std::vector<const std::vector<TimeSeries>*>& runs, const Plot& plot) {
  Plot::Curve curve{label, {}};
  for (const double time : times) {
    Sample sample{{}, {plot.support, {}}};
    sample.values.reserve(runs.size());
    for (const std::vector<TimeSeries>* agents : runs)
      sample.values.push_back(mean_at(*agents, time));
    Plot::Mark& mark = curve.marks.emplace_back(mark_of(sample, plot.interval));
    mark.x = time;
  }
  return curve;
}

/// Notes the warm-up by MSER-5. That needs values of equal weight, so a series that was recorded on
/// change is read at equidistant times.
void note_warm_up(Plot& plot, const Plot::Curve& curve) {
  TimeSeries series;
  for (const Plot::Mark& mark : curve.marks) series.emplace_back(mark.x, mark.y);
  std::vector<double> times = times_of(series);
  if (times.size() < 2) return;
  if (!is_periodic(times)) times = equidistant(times.front(), times.back());
  if (times.size() < kEnoughForWarmUp) return;
  std::vector<double> means;
  means.reserve(times.size());
  for (const double time : times) means.push_back(value_at(series, time));
  const auto warm_up = statistics::mser(means);
  if (!warm_up) return;
  plot.notes.push_back(
      warm_up->is_too_short
          ? fmt::format("{}: has not settled by MSER-5; run it for longer", curve.label)
          : fmt::format("{}: warm-up by MSER-5 until {:g} s", curve.label, times[warm_up->values]));
}

}  // namespace

std::map<std::size_t, std::vector<Experiment::TimeSeries>> series_of(
    const Experiment& experiment, const sim::scenario::PlotRequest& request) {
  std::map<std::size_t, std::vector<TimeSeries>> found;
  const auto add = [&](const Experiment::Quantity& quantity) {
    const auto by_run = experiment.series.find(quantity);
    if (by_run == experiment.series.end()) return;
    for (const auto& [run, series] : by_run->second) {
      if (!series.empty()) found[run].push_back(series);
    }
  };
  add({request.plot, request.agent});
  if (!found.empty() || !request.agent.empty()) return found;
  for (const auto& [quantity, by_run] : experiment.series) {
    if (quantity.name == request.plot) add(quantity);
  }
  return found;
}

void add_time(Plot& plot, const Experiment& experiment, const sim::scenario::PlotRequest& request) {
  const auto by_run = series_of(experiment, request);
  if (by_run.empty()) {
    throw std::runtime_error(fmt::format(
        "{}: was not recorded over time; `record: {{observables: …}}` of the scenario does that",
        request.plot));
  }
  plot.x_label = "simulated time / s";
  for (std::size_t i = 0; i < experiment.points.size(); ++i) {
    std::vector<const std::vector<TimeSeries>*> runs;
    std::vector<const TimeSeries*> all;
    std::vector<std::size_t> places;
    for (const std::size_t run : experiment.points[i].runs) {
      const auto found = by_run.find(run);
      if (found == by_run.end()) continue;
      runs.push_back(&found->second);
      places.push_back(run);
      for (const TimeSeries& series : found->second) all.push_back(&series);
    }
    if (runs.empty()) continue;
    plot.curves.push_back(
        curve_of(experiment.label(i), common_times(all, end_of(experiment, places)), runs, plot));
    note_warm_up(plot, plot.curves.back());
  }
}

}  // namespace results::report
