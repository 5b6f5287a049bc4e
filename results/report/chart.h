#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "results/report/drawing.h"

namespace results::report {

/// A figure of numbers that are at hand, in one panel or several. (A Plot is one of quantities of
/// an experiment.) Layers are drawn in their order.
///
/// No value is left out in silence. A mark or bar that is not within the limits, or a line that is
/// nowhere within them, is counted in a note in its panel; so is a value without a position: not
/// finite, or not above 0 on a logarithmic axis, where a line has a gap. A line, interval or bar
/// that leaves the limits is cut off there; an interval then has no cap.
struct Chart {
  struct Style {
    std::string label{};        ///< In the legend; equal labels share an entry. Empty: none.
    int curve = 0;              ///< Gives the colour; kNeutral: grey.
    const char* dash = "none";  ///< SVG's stroke-dasharray.
    double width = 1.5;         ///< Of lines, px.
    double opacity = 1;
  };

  /// Through points in their order; stepped: each y holds until the next x.
  struct Line {
    Style style{};
    std::vector<double> x{}, y{};
    bool is_stepped = false;
  };

  /// Marks, with intervals of y if `low` and `high` are not empty.
  struct Marks {
    Style style{};
    std::vector<double> x{}, y{};
    std::vector<double> low{}, high{};
    Symbol symbol = symbol_of(0);
    double scale = 1;  ///< Of the symbol.
  };

  /// Upright bars from 0 (on a logarithmic axis, from its end), of several series: side by side at
  /// each place, or stacked.
  struct Bars {
    struct Series {
      Style style{};
      std::vector<double> y{};            ///< As many as there are places.
      std::vector<double> low{}, high{};  ///< Intervals of y; not of stacked bars.
      std::vector<std::string> texts{};   ///< Above the bars.
    };
    std::vector<double> at{};  ///< Places along x.
    double width = 0.8;        ///< Of the bars at a place together, in units of x.
    bool is_stacked = false;
    std::vector<Series> series{};
  };

  /// A straight line across the panel.
  struct Reference {
    Style style{};
    double at = 0;
    bool is_upright = true;  ///< At this x; otherwise at this y.
  };

  /// A shaded range of x.
  struct Span {
    Style style{};
    double from = 0, to = 0;
  };

  /// Short text that is read upwards and ends at a point, to the right of it.
  struct Text {
    Style style{};
    double x = 0, y = 0;
    std::string text{};
  };

  using Layer = std::variant<Line, Marks, Bars, Reference, Span, Text>;

  struct Scale {
    std::string label{};
    bool is_log = false;
    std::optional<double> low{}, high{};  ///< Limits; none: from the layers.
    std::vector<double> ticks{};          ///< Empty: round numbers.
    std::vector<std::string> names{};     ///< In place of numbers, at 0, 1, 2, …
  };

  struct Panel {
    std::string title{};
    Scale x{}, y{};
    std::vector<Layer> layers{};
  };

  std::string title;                 ///< For readers who do not see the figure.
  double width = 640, height = 340;  ///< px
  std::size_t columns = 1;
  bool shares_x = false, shares_y = false;  ///< Limits that follow from the layers of all panels.
  std::vector<Panel> panels;                ///< By row.
};

/// The limits of a panel's axis: those that are given, otherwise those of its layers with a margin.
/// Bars begin at 0, as does an axis whose least value is 0.
/// @throws std::invalid_argument  the limits are no range, or not above 0 on a logarithmic axis
struct Limits {
  Axis x, y;  ///< Without positions.
};
std::vector<Limits> limits_of(const Chart& chart);

/// One end of a bar and the other, in units of y.
struct BarEnds {
  double from = 0, to = 0;
};
/// Of bar i of a series. In a stack, what is above 0 is added up from 0 upwards, what is below
/// downwards, and what is not finite not at all.
BarEnds ends_of(const Chart::Bars& bars, std::size_t series, std::size_t i);

/// The chart as a self-contained drawing on white: see svg.h.
/// @throws std::invalid_argument  columns of numbers that belong together differ in length, there
///   is no panel, or it is too small for its texts, or see limits_of()
std::string svg(const Chart& chart);

}  // namespace results::report
