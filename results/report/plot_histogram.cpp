#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "results/report/plot_parts.h"

namespace results::report {
namespace {

using BinCounts = std::map<std::pair<double, double>, std::uint64_t>;

bool is_asked(const Experiment::Quantity& quantity, const sim::scenario::PlotRequest& request) {
  return quantity.name == request.plot &&
         (request.agent.empty() || quantity.agent == request.agent);
}

BinCounts recorded_bins(const Experiment& experiment, const sim::scenario::PlotRequest& request,
                        const Experiment::Point& point) {
  BinCounts counts;
  for (const auto& [quantity, by_run] : experiment.bins) {
    if (!is_asked(quantity, request)) continue;
    for (const std::size_t run : point.runs) {
      const auto found = by_run.find(run);
      if (found == by_run.end()) continue;
      for (const auto& bin : found->second) counts[{bin.lower, bin.upper}] += bin.count;
    }
  }
  return counts;
}

void add_samples(const std::vector<Experiment::TimeSeries>& all, std::vector<double>& samples) {
  for (const Experiment::TimeSeries& series : all) {
    for (const auto& [at, value] : series) samples.push_back(value);
  }
}

/// The value of each run of a point.
std::vector<double> values_of(const Experiment& experiment,
                              const sim::scenario::PlotRequest& request,
                              const Experiment::Point& point) {
  std::vector<double> values;
  for (const auto& [quantity, by_run] : experiment.values) {
    if (!is_asked(quantity, request)) continue;
    for (const std::size_t run : point.runs) {
      const auto found = by_run.find(run);
      if (found != by_run.end()) values.push_back(found->second);
    }
  }
  return values;
}

/// All samples of a point's runs, or the value of each run if the quantity has no samples.
std::vector<double> samples_of(const Experiment& experiment,
                               const sim::scenario::PlotRequest& request,
                               const Experiment::Point& point) {
  const auto by_run = series_of(experiment, request);
  if (by_run.empty()) return values_of(experiment, request, point);
  std::vector<double> samples;
  for (const std::size_t run : point.runs) {
    const auto found = by_run.find(run);
    if (found != by_run.end()) add_samples(found->second, samples);
  }
  return samples;
}

/// Bins of equal width over all samples. Their number follows from the point with most samples by
/// the rule of H. A. Sturges ("The Choice of a Class Interval", 1926), but is at least 10.
std::vector<BinCounts> binned(const std::vector<std::vector<double>>& samples) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  std::size_t most = 1;
  for (const auto& some : samples) {
    most = std::max(most, some.size());
    for (const double value : some) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  const auto bins = static_cast<std::size_t>(
      std::max(10.0, std::ceil(static_cast<double>(std::bit_width(most)) + 1)));
  const double width = high > low ? (high - low) / static_cast<double>(bins) : 1;
  const auto edge = [&](std::size_t i) { return low + static_cast<double>(i) * width; };
  std::vector<BinCounts> counts(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (const double value : samples[i]) {
      const double place = (value - low) / width;
      const auto last = static_cast<double>(bins - 1);
      const auto bin = static_cast<std::size_t>(place > 0 ? std::min(place, last) : 0);
      ++counts[i][{edge(bin), edge(bin + 1)}];
    }
  }
  return counts;
}

Plot::Curve curve_of(Plot& plot, const std::string& label, const BinCounts& counts) {
  Plot::Curve curve{label, {}};
  for (const auto& [edges, count] : counts) {
    const auto& [low, high] = edges;
    if (!std::isfinite(low) || !std::isfinite(high)) {
      if (count > 0) {
        plot.notes.push_back(fmt::format("{}: {} values {} {:g} are beyond the bins", label, count,
                                         std::isfinite(low) ? "from" : "below",
                                         std::isfinite(low) ? low : high));
      }
      continue;
    }
    Plot::Mark& mark = curve.marks.emplace_back();
    mark.x = (low + high) / 2;
    mark.width = high - low;
    mark.y = static_cast<double>(count);
    mark.count = count;
  }
  return curve;
}

}  // namespace

void add_histogram(Plot& plot, const Experiment& experiment,
                   const sim::scenario::PlotRequest& request) {
  plot.x_label = plot.y_label;
  plot.y_label = "count";
  std::vector<BinCounts> counts;
  std::vector<std::vector<double>> samples;
  for (const Experiment::Point& point : experiment.points) {
    counts.push_back(recorded_bins(experiment, request, point));
    samples.push_back(samples_of(experiment, request, point));
  }
  const auto is_empty = [](const auto& one) { return one.empty(); };
  if (std::ranges::all_of(counts, is_empty)) counts = binned(samples);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (!counts[i].empty()) plot.curves.push_back(curve_of(plot, experiment.label(i), counts[i]));
  }
  if (plot.curves.empty()) {
    throw std::runtime_error(fmt::format("{}: there are no values to count", request.plot));
  }
}

}  // namespace results::report
