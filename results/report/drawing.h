#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "results/report/axis.h"

namespace results::report {

/// Colour of the curves of a number: M. Okabe and K. Ito, "Color Universal Design", 2008. Repeats
/// after eight. kNeutral: grey, for what belongs to no curve.
inline constexpr int kNeutral = -1;
const char* colour_of(int curve);

/// Dashes of the curves of a number: they differ where colours repeat.
const char* dash_of(int curve);

/// A mark: path about (0, 0), px.
struct Symbol {
  std::string_view path;
  bool is_filled = true;
};
/// Filled symbol of the curves of a number; the first is a circle. Repeats after five.
Symbol symbol_of(std::size_t curve);
inline constexpr Symbol kCross{"M-3.5,-3.5l7,7m0,-7l-7,7", false};
inline constexpr Symbol kPlus{"M-4.5,0h9m-4.5,-4.5v9", false};

/// The text in an XML document.
std::string escaped(const std::string& text);

/// Estimated width of a text of UTF-8, px, 12 px high in common sans-serif fonts.
double width_of(const std::string& text);

/// Rectangle, px.
struct Box {
  double left = 0, top = 0, width = 0, height = 0;
};

/// The two axes that a panel's data are drawn to; y grows upwards, so that its `from` is below.
struct Frame {
  Axis x, y;
  double left() const { return x.from; }
  double right() const { return x.to; }
  double top() const { return y.to; }
  double bottom() const { return y.from; }
};

/// How a line is drawn.
struct Stroke {
  const char* dash = "none";
  double width = 1.5;  ///< px
  double opacity = 1;
};

/// What a mark or bar says to a reader who points at it, and to programs.
struct Tip {
  std::string attributes{};  ///< XML, each after a space: ` data-runs="5"`.
  std::string title{};       ///< Not yet escaped.
};

/// The shapes of figures, appended as elements of Scalable Vector Graphics 1.1. Positions are in
/// px from the upper left corner. Classes are those that svg.h lists.
class Drawing {
 public:
  struct Entry {
    int curve = 0;
    std::string label;
    bool has_line = true;
    Stroke stroke{};
    Symbol symbol{""};
    double box_opacity = 0;  ///< Above 0: a box of it, for bars and spans.
  };

  /// Axes without ticks.
  void axes(const Frame& frame);
  void x_tick(const Frame& frame, double value, const std::string& text, bool is_slanted = false);
  void y_tick(const Frame& frame, double value, const std::string& text);
  /// Names of the axes, at these distances from the frame.
  void axis_labels(const Frame& frame, const std::string& x, double below, const std::string& y,
                   double beside);

  /// All until close() has this curve's class and colour.
  void open_curve(int curve);
  void open_shifted(double right);
  /// All until close_clip() is cut off at the frame.
  void open_clip(const Frame& frame);
  void close_clip() { text_ += "</svg>\n"; }
  void open_legend() { text_ += "<g class=\"legend\">\n"; }
  void close() { text_ += "</g>\n"; }

  void line(const std::string& path, const Stroke& stroke);
  void area(const std::string& path, double opacity);
  void bin(const Box& box, double opacity, const Tip& tip);
  struct Look {
    double scale = 1, opacity = 1;
  };
  void point(double x, double y, const Symbol& symbol, const Tip& tip, const Look& look);
  /// An interval of y with caps of 8 px, from one position to the other; without those at ends
  /// that are cut off.
  void interval(double x, double low, double high, bool low_cap = true, bool high_cap = true);
  void legend_entry(double x, double y, const Entry& entry);
  /// @param attributes  XML, each after a space
  void words(const std::string& text, const std::string& attributes);
  void background(double width, double height);

  /// The document.
  std::string document(double width, double height, const std::string& title) const;

 private:
  std::string text_;
};

}  // namespace results::report
