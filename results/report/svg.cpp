#include "results/report/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/report/axis.h"
#include "results/report/drawing.h"

namespace results::report {
namespace {

constexpr double kWidth = 440, kHeight = 280;  // px, size of the plot area
constexpr double kLeft = 76, kTop = 40, kBottom = 56;
constexpr double kPerLetter = 6.6;  // px, as in width_of()
constexpr double kLegendRow = 18;

/// A plot of an experiment, drawn with the shapes of Drawing.
class PlotDrawing {
 public:
  explicit PlotDrawing(const Plot& plot) : plot_(plot) {
    Extent x;
    Extent y;
    for (const Plot::Curve& curve : plot.curves) {
      for (const Plot::Mark& mark : curve.marks) {
        x.add(mark.x - mark.width / 2);
        x.add(mark.x + mark.width / 2);
        y.add(mark.y);
        if (mark.interval) y.add(mark.interval->low);
        if (mark.interval) y.add(mark.interval->high);
      }
    }
    if (!plot.categories.empty()) {
      x = {-0.5, static_cast<double>(plot.categories.size()) - 0.5};
    } else {
      x = x.padded(plot.kind == sim::scenario::PlotKind::kPoints ? 0.05 : 0);
    }
    if (plot.kind == sim::scenario::PlotKind::kHistogram) y.add(0);
    const bool starts_at_0 = y.low == 0;
    y = y.padded(0.06);
    if (starts_at_0) y.low = 0;
    frame_ = {{x.low, x.high, kLeft, kLeft + kWidth}, {y.low, y.high, kTop + kHeight, kTop}};
  }

  std::string text() {
    out_.words(plot_.title, fmt::format(" class=\"title\" x=\"{}\" y=\"20\" font-size=\"14\" "
                                        "font-weight=\"bold\"",
                                        kLeft));
    draw_axes();
    for (std::size_t i = 0; i < plot_.curves.size(); ++i) draw_curve(i);
    if (plot_.curves.size() > 1) draw_legend();
    const double width = kLeft + kWidth + legend_width();
    const double legend = kTop + kLegendRow * (2 + static_cast<double>(plot_.curves.size()));
    const double height = std::max(kTop + kHeight + kBottom, plot_.curves.size() > 1 ? legend : 0);
    return out_.document(width, height, plot_.title);
  }

 private:
  double legend_width() const {
    if (plot_.curves.size() < 2) return 16;
    std::size_t letters = plot_.curves_are.size();
    for (const auto& curve : plot_.curves) letters = std::max(letters, curve.label.size());
    return 60 + kPerLetter * static_cast<double>(letters);
  }

  void draw_axes() {
    out_.axes(frame_);
    const Axis& x = frame_.x;
    const Axis& y = frame_.y;
    for (const double value : ticks(y.low, y.high, 6))
      out_.y_tick(frame_, value, fmt::format("{:g}", value));
    if (plot_.categories.empty()) {
      for (const double value : ticks(x.low, x.high, 7))
        out_.x_tick(frame_, value, fmt::format("{:g}", value));
    }
    for (std::size_t i = 0; i < plot_.categories.size(); ++i)
      out_.x_tick(frame_, static_cast<double>(i), plot_.categories[i]);
    out_.axis_labels(frame_, plot_.x_label, 42, plot_.y_label, kLeft - 16);
  }

  std::string title_of(const Plot::Curve& curve, const Plot::Mark& mark) const {
    const std::string x = mark.x_text.empty() ? fmt::format("{:.6g}", mark.x) : mark.x_text;
    std::string text =
        fmt::format("{}{}{}: {:.6g}", curve.label, curve.label.empty() ? "" : ", ", x, mark.y);
    if (mark.interval) {
      text += fmt::format(" [{:.6g}, {:.6g}]", mark.interval->low, mark.interval->high);
    }
    if (plot_.kind != sim::scenario::PlotKind::kHistogram)
      text += fmt::format(", {} runs", mark.count);
    return text;
  }

  void draw_curve(std::size_t i) {
    const Plot::Curve& curve = plot_.curves[i];
    out_.open_curve(static_cast<int>(i));
    if (plot_.kind == sim::scenario::PlotKind::kTime) {
      draw_band(curve);
      draw_line(i);
    } else if (plot_.kind == sim::scenario::PlotKind::kHistogram) {
      for (const Plot::Mark& mark : curve.marks) draw_bin(curve, mark);
    } else {
      draw_points(i);
    }
    out_.close();
  }

  void draw_line(std::size_t i) {
    std::string path;
    for (const Plot::Mark& mark : plot_.curves[i].marks) {
      path += fmt::format("{}{:.2f},{:.2f}", path.empty() ? 'M' : 'L', frame_.x.at(mark.x),
                          frame_.y.at(mark.y));
    }
    out_.line(path, {dash_of(static_cast<int>(i))});
  }

  /// Fills the area between the ends of the intervals.
  void draw_band(const Plot::Curve& curve) {
    std::string there;
    std::string back;
    for (const Plot::Mark& mark : curve.marks) {
      if (!mark.interval) return;
      const double x = frame_.x.at(mark.x);
      there += fmt::format("{}{:.2f},{:.2f}", there.empty() ? 'M' : 'L', x,
                           frame_.y.at(mark.interval->high));
      back.insert(0, fmt::format("L{:.2f},{:.2f}", x, frame_.y.at(mark.interval->low)));
    }
    out_.area(there + back + "Z", 0.2);
  }

  void draw_bin(const Plot::Curve& curve, const Plot::Mark& mark) {
    const double left = frame_.x.at(mark.x - mark.width / 2);
    const double top = frame_.y.at(mark.y);
    const double width = std::max(0.5, frame_.x.at(mark.x + mark.width / 2) - left);
    out_.bin({left, top, width, frame_.y.at(frame_.y.low) - top},
             plot_.curves.size() > 1 ? 0.25 : 0.6,
             {fmt::format(" data-count=\"{}\"", mark.count), title_of(curve, mark)});
  }

  /// Sideways offset of curve i, px, so that intervals at the same x do not hide each other.
  double shift(std::size_t i) const {
    if (plot_.curves.size() < 2) return 0;
    const double middle = static_cast<double>(plot_.curves.size() - 1) / 2;
    return 4 * (static_cast<double>(i) - middle);
  }

  void draw_points(std::size_t i) {
    const Plot::Curve& curve = plot_.curves[i];
    out_.open_shifted(shift(i));
    const bool is_cloud = plot_.curves_are.starts_with("no line");
    if (!is_cloud && curve.marks.size() > 1) draw_line(i);
    for (const Plot::Mark& mark : curve.marks) {
      const double x = frame_.x.at(mark.x);
      if (mark.interval)
        out_.interval(x, frame_.y.at(mark.interval->low), frame_.y.at(mark.interval->high));
      out_.point(
          x, frame_.y.at(mark.y), symbol_of(i),
          {fmt::format(" data-x=\"{}\" data-y=\"{}\" data-runs=\"{}\"", mark.x, mark.y, mark.count),
           title_of(curve, mark)},
          {});
    }
    out_.close();
  }

  void draw_legend() {
    const double x = kLeft + kWidth + 24;
    out_.open_legend();
    out_.words(plot_.curves_are,
               fmt::format(" x=\"{}\" y=\"{}\" font-style=\"italic\"", x, kTop + 4));
    for (std::size_t i = 0; i < plot_.curves.size(); ++i) {
      const int curve = static_cast<int>(i);
      const bool has_points = plot_.kind == sim::scenario::PlotKind::kPoints;
      out_.legend_entry(x, kTop + 4 + kLegendRow * static_cast<double>(i + 1),
                        {.curve = curve,
                         .label = plot_.curves[i].label,
                         .stroke = {dash_of(curve)},
                         .symbol = has_points ? symbol_of(i) : Symbol{""}});
    }
    out_.close();
  }

  const Plot& plot_;
  Frame frame_;
  Drawing out_;
};

}  // namespace

std::string svg(const Plot& plot) { return PlotDrawing(plot).text(); }

}  // namespace results::report
