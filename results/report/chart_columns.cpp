#include <fmt/format.h>

#include <stdexcept>

#include "results/report/chart_layers.h"

namespace results::report {
namespace {

struct ColumnCheck {
  static void require(const char* what, std::size_t found, std::size_t needed) {
    if (found != needed)
      throw std::invalid_argument(fmt::format("{}: {} values, not {}", what, found, needed));
  }
  /// Intervals of y, if there are any.
  static void require_intervals(const std::vector<double>& low, const std::vector<double>& high,
                                std::size_t needed) {
    if (low.empty() && high.empty()) return;
    require("low ends of intervals", low.size(), needed);
    require("high ends of intervals", high.size(), needed);
  }

  void operator()(const Chart::Line& line) const {
    require("y of a line", line.y.size(), line.x.size());
  }
  void operator()(const Chart::Marks& marks) const {
    require("y of marks", marks.y.size(), marks.x.size());
    require_intervals(marks.low, marks.high, marks.x.size());
  }
  void operator()(const Chart::Bars& bars) const {
    for (const Chart::Bars::Series& series : bars.series) {
      require("y of bars", series.y.size(), bars.at.size());
      require_intervals(series.low, series.high, bars.at.size());
      if (!series.texts.empty()) require("texts of bars", series.texts.size(), bars.at.size());
    }
  }
  void operator()(const Chart::Reference&) const {}
  void operator()(const Chart::Span&) const {}
  void operator()(const Chart::Text&) const {}
};

}  // namespace

void check_columns(const Chart& chart) {
  for (const Chart::Panel& panel : chart.panels) {
    for (const Chart::Layer& layer : panel.layers) std::visit(ColumnCheck{}, layer);
  }
}

}  // namespace results::report
