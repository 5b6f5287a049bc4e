#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "results/report/chart.h"

namespace results::report {
namespace {

constexpr double kMargin = 0.05;  // of the range of the values, at each end

/// Collects the range of what the layers of a panel show.
struct LayerExtents {
  bool x_is_log, y_is_log;
  Extent x{}, y{};

  void add_x(double value) {
    if (!x_is_log || value > 0) x.add(value);
  }
  void add_y(double value) {
    if (!y_is_log || value > 0) y.add(value);
  }

  void operator()(const Chart::Line& line) {
    for (const double value : line.x) add_x(value);
    for (const double value : line.y) add_y(value);
  }
  void operator()(const Chart::Marks& marks) {
    for (const double value : marks.x) add_x(value);
    for (const auto* values : {&marks.y, &marks.low, &marks.high}) {
      for (const double value : *values) add_y(value);
    }
  }
  void operator()(const Chart::Bars& bars) {
    add_y(0);
    for (const double at : bars.at) {
      add_x(at - bars.width / 2);
      add_x(at + bars.width / 2);
    }
    for (std::size_t one = 0; one < bars.series.size(); ++one) {
      const Chart::Bars::Series& series = bars.series[one];
      for (std::size_t i = 0; i < series.y.size(); ++i) add_y(ends_of(bars, one, i).to);
      for (const double value : series.low) add_y(value);
      for (const double value : series.high) add_y(value);
    }
  }
  void operator()(const Chart::Reference& line) {
    line.is_upright ? add_x(line.at) : add_y(line.at);
  }
  void operator()(const Chart::Span& span) {
    add_x(span.from);
    add_x(span.to);
  }
  void operator()(const Chart::Text&) {}
};

Axis axis_of(const Chart::Scale& scale, const Extent& values) {
  Extent range = scale.is_log ? values.log_padded(kMargin) : values.padded(kMargin);
  if (!scale.is_log && values.low == 0) range.low = 0;
  if (!scale.names.empty()) range = {-0.5, static_cast<double>(scale.names.size()) - 0.5};
  const Axis axis{.low = scale.low.value_or(range.low),
                  .high = scale.high.value_or(range.high),
                  .is_log = scale.is_log};
  if (!std::isfinite(axis.low) || !std::isfinite(axis.high) || axis.low >= axis.high) {
    throw std::invalid_argument(
        fmt::format("'{}': {} .. {} are no limits", scale.label, axis.low, axis.high));
  }
  if (scale.is_log && axis.low <= 0) {
    throw std::invalid_argument(
        fmt::format("'{}': a logarithmic axis cannot begin at {}", scale.label, axis.low));
  }
  return axis;
}

void merge(Extent& into, const Extent& other) {
  into.add(other.low);
  into.add(other.high);
}

}  // namespace

std::vector<Limits> limits_of(const Chart& chart) {
  std::vector<LayerExtents> found;
  found.reserve(chart.panels.size());
  Extent all_x, all_y;
  for (const Chart::Panel& panel : chart.panels) {
    LayerExtents& extents = found.emplace_back(LayerExtents{panel.x.is_log, panel.y.is_log});
    for (const Chart::Layer& layer : panel.layers) std::visit(extents, layer);
    merge(all_x, extents.x);
    merge(all_y, extents.y);
  }
  std::vector<Limits> limits;
  limits.reserve(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Chart::Panel& panel = chart.panels[i];
    limits.push_back({axis_of(panel.x, chart.shares_x ? all_x : found[i].x),
                      axis_of(panel.y, chart.shares_y ? all_y : found[i].y)});
  }
  return limits;
}

BarEnds ends_of(const Chart::Bars& bars, std::size_t series, std::size_t i) {
  const double value = bars.series.at(series).y.at(i);
  if (!bars.is_stacked) return {0, value};
  double from = 0;
  for (std::size_t below = 0; below < series; ++below) {
    const double other = bars.series[below].y.at(i);
    if (std::isfinite(other) && (other > 0) == (value > 0)) from += other;
  }
  return {from, from + value};
}

}  // namespace results::report
