#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "results/report/chart.h"

namespace results::report {

/// Draws the layers of a panel into its frame, and counts what is not shown.
class LayerDrawing {
 public:
  LayerDrawing(Drawing& out, const Frame& frame) : out_(out), frame_(frame) {}

  void operator()(const Chart::Line& line);
  void operator()(const Chart::Marks& marks);
  void operator()(const Chart::Bars& bars);
  void operator()(const Chart::Reference& line);
  void operator()(const Chart::Span& span);
  void operator()(const Chart::Text& text);

  /// What the layers so far do not show: "2 values outside the limits, 1 without a position". "":
  /// they show everything.
  std::string note() const;

 private:
  bool counts_as_shown(double x, double y);
  std::string path_of(const Chart::Line& line);
  void draw_interval(double x, double low, double high);
  void draw_bar(const Chart::Bars& bars, std::size_t series, std::size_t i);
  void draw_above(double x, double y, const Chart::Bars::Series& series, std::size_t i);

  Drawing& out_;
  Frame frame_;
  std::size_t outside_ = 0, without_position_ = 0;
};

/// @throws std::invalid_argument  columns of numbers that belong together differ in length
void check_columns(const Chart& chart);

/// What the legend of a panel says, by label.
std::vector<Drawing::Entry> legend_of(const Chart::Panel& panel);

}  // namespace results::report
