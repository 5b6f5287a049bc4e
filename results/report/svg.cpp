#include "results/report/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hal/types/math.h"
#include "results/report/axis.h"

namespace results::report {
namespace {

constexpr std::array kColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                 "#E69F00", "#56B4E9", "#000000", "#8A6D00"};
constexpr std::array kDashes = {"none", "6 3", "2 2", "8 3 2 3"};
constexpr double kWidth = 440, kHeight = 280;  // px, size of the plot area
constexpr double kLeft = 76, kTop = 40, kBottom = 56;
constexpr double kPerLetter = 6.6;  // px, of the 12 px letters of common sans-serif fonts
constexpr double kLegendRow = 18;

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return result;
}

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// The range extended by a margin of this share; never empty.
  Extent padded(double share) const {
    if (!(low <= high)) return {0, 1};
    const double span = high > low ? high - low : std::max(1e-12, std::abs(high) * 0.2);
    const double room = high > low ? share : std::max(share, 0.05);
    return {low - room * span, high + room * span};
  }
};

class Drawing {
 public:
  explicit Drawing(const Plot& plot) : plot_(plot) {
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
    x_ = {x.low, x.high, kLeft, kLeft + kWidth};
    y_ = {y.low, y.high, kTop + kHeight, kTop};
  }

  std::string text() {
    draw_axes();
    for (std::size_t i = 0; i < plot_.curves.size(); ++i) draw_curve(i);
    if (plot_.curves.size() > 1) draw_legend();
    return head() + out_ + "</svg>\n";
  }

 private:
  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Values>(values)...);
  }

  double legend_width() const {
    if (plot_.curves.size() < 2) return 16;
    std::size_t letters = plot_.curves_are.size();
    for (const auto& curve : plot_.curves) letters = std::max(letters, curve.label.size());
    return 60 + kPerLetter * static_cast<double>(letters);
  }

  std::string head() const {
    const double width = kLeft + kWidth + legend_width();
    const double legend = kTop + kLegendRow * (2 + static_cast<double>(plot_.curves.size()));
    const double height = std::max(kTop + kHeight + kBottom, plot_.curves.size() > 1 ? legend : 0);
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
        "width=\"{0:.0f}\" height=\"{1:.0f}\" role=\"img\" aria-label=\"{2}\" "
        "font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" font-size=\"12\">\n"
        "<title>{2}</title>\n"
        "<text class=\"title\" x=\"{3}\" y=\"20\" font-size=\"14\" "
        "font-weight=\"bold\">{2}</text>\n",
        width, height, escaped(plot_.title), kLeft);
  }

  void draw_axes() {
    const double bottom = kTop + kHeight;
    add("<g class=\"axis\" stroke=\"#444\" fill=\"none\">\n"
        "<path d=\"M{0},{1}V{2}H{3}\"/>\n</g>\n",
        kLeft, kTop, bottom, kLeft + kWidth);
    for (const double value : ticks(y_.low, y_.high, 6)) draw_y_tick(value);
    if (plot_.categories.empty()) {
      for (const double value : ticks(x_.low, x_.high, 7))
        draw_x_tick(value, fmt::format("{:g}", value));
    }
    for (std::size_t i = 0; i < plot_.categories.size(); ++i) {
      draw_x_tick(static_cast<double>(i), plot_.categories[i]);
    }
    add("<text class=\"label\" text-anchor=\"middle\" x=\"{}\" y=\"{}\">{}</text>\n",
        kLeft + kWidth / 2, bottom + 42, escaped(plot_.x_label));
    add("<text class=\"label\" text-anchor=\"middle\" "
        "transform=\"translate(16,{}) rotate(-90)\">{}</text>\n",
        kTop + kHeight / 2, escaped(plot_.y_label));
  }

  void draw_y_tick(double value) {
    const double y = y_.at(value);
    add("<path class=\"grid\" d=\"M{:.2f},{:.2f}H{:.2f}\" stroke=\"#ddd\"/>", kLeft, y,
        kLeft + kWidth);
    add("<text class=\"tick\" text-anchor=\"end\" x=\"{:.2f}\" y=\"{:.2f}\">{:g}</text>\n",
        kLeft - 6, y + 4, value);
  }

  void draw_x_tick(double value, const std::string& text) {
    const double x = x_.at(value);
    add("<path class=\"axis\" d=\"M{:.2f},{:.2f}v5\" stroke=\"#444\"/>", x, kTop + kHeight);
    add("<text class=\"tick\" text-anchor=\"middle\" x=\"{:.2f}\" y=\"{:.2f}\">{}</text>\n", x,
        kTop + kHeight + 19, escaped(text));
  }

  static const char* colour(std::size_t curve) { return kColours.at(curve % kColours.size()); }
  static const char* dash(std::size_t curve) {
    return kDashes.at(curve / kColours.size() % kDashes.size());
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
    return escaped(text);
  }

  void draw_curve(std::size_t i) {
    const Plot::Curve& curve = plot_.curves[i];
    add("<g class=\"curve curve-{}\" color=\"{}\">\n", i, colour(i));
    if (plot_.kind == sim::scenario::PlotKind::kTime) {
      draw_band(curve);
      draw_line(curve, dash(i));
    } else if (plot_.kind == sim::scenario::PlotKind::kHistogram) {
      for (const Plot::Mark& mark : curve.marks) draw_bin(curve, mark);
    } else {
      draw_points(i);
    }
    add("</g>\n");
  }

  std::string path_of(const Plot::Curve& curve) const {
    std::string path;
    for (const Plot::Mark& mark : curve.marks) {
      path +=
          fmt::format("{}{:.2f},{:.2f}", path.empty() ? 'M' : 'L', x_.at(mark.x), y_.at(mark.y));
    }
    return path;
  }

  void draw_line(const Plot::Curve& curve, const char* dashes) {
    add("<path class=\"line\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"1.5\" "
        "stroke-dasharray=\"{}\" d=\"{}\"/>\n",
        dashes, path_of(curve));
  }

  /// Fills the area between the ends of the intervals.
  void draw_band(const Plot::Curve& curve) {
    std::string there;
    std::string back;
    for (const Plot::Mark& mark : curve.marks) {
      if (!mark.interval) return;
      there += fmt::format("{}{:.2f},{:.2f}", there.empty() ? 'M' : 'L', x_.at(mark.x),
                           y_.at(mark.interval->high));
      back.insert(0, fmt::format("L{:.2f},{:.2f}", x_.at(mark.x), y_.at(mark.interval->low)));
    }
    add("<path class=\"band\" fill=\"currentColor\" opacity=\"0.2\" d=\"{}{}Z\"/>\n", there, back);
  }

  void draw_bin(const Plot::Curve& curve, const Plot::Mark& mark) {
    const double left = x_.at(mark.x - mark.width / 2);
    const double top = y_.at(mark.y);
    add("<rect class=\"bin\" data-count=\"{}\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" "
        "height=\"{:.2f}\" fill=\"currentColor\" fill-opacity=\"{}\" stroke=\"currentColor\">"
        "<title>{}</title></rect>\n",
        mark.count, left, top, std::max(0.5, x_.at(mark.x + mark.width / 2) - left),
        y_.at(y_.low) - top, plot_.curves.size() > 1 ? 0.25 : 0.6, title_of(curve, mark));
  }

  /// Sideways offset of curve i, px, so that intervals at the same x do not hide each other.
  double shift(std::size_t i) const {
    if (plot_.curves.size() < 2) return 0;
    const double middle = static_cast<double>(plot_.curves.size() - 1) / 2;
    return 4 * (static_cast<double>(i) - middle);
  }

  void draw_points(std::size_t i) {
    const Plot::Curve& curve = plot_.curves[i];
    add("<g transform=\"translate({:.1f},0)\">\n", shift(i));
    const bool is_cloud = plot_.curves_are.starts_with("no line");
    if (!is_cloud && curve.marks.size() > 1) draw_line(curve, dash(i));
    for (const Plot::Mark& mark : curve.marks) {
      const double x = x_.at(mark.x);
      if (mark.interval) draw_interval(x, *mark.interval);
      add("<path class=\"point\" data-x=\"{}\" data-y=\"{}\" data-runs=\"{}\" "
          "fill=\"currentColor\" "
          "transform=\"translate({:.2f},{:.2f})\" d=\"{}\"><title>{}</title></path>\n",
          mark.x, mark.y, mark.count, x, y_.at(mark.y), symbol(i), title_of(curve, mark));
    }
    add("</g>\n");
  }

  void draw_interval(double x, const statistics::Interval& interval) {
    const double low = y_.at(interval.low);
    const double high = y_.at(interval.high);
    add("<path class=\"interval\" stroke=\"currentColor\" fill=\"none\" "
        "d=\"M{0:.2f},{1:.2f}h8m-4,0V{2:.2f}m-4,0h8\"/>\n",
        x - 4, low, high);
  }

  static const char* symbol(std::size_t curve) {
    static constexpr std::array kSymbols = {"M-4,0a4,4 0 1,0 8,0a4,4 0 1,0 -8,0Z",
                                            "M-3.5,-3.5h7v7h-7Z", "M0,-4.8L4.4,3.4H-4.4Z",
                                            "M0,-5L5,0L0,5L-5,0Z", "M0,4.8L4.4,-3.4H-4.4Z"};
    return kSymbols.at(curve % kSymbols.size());
  }

  void draw_legend() {
    const double x = kLeft + kWidth + 24;
    add("<g class=\"legend\">\n<text x=\"{}\" y=\"{}\" font-style=\"italic\">{}</text>\n", x,
        kTop + 4, escaped(plot_.curves_are));
    for (std::size_t i = 0; i < plot_.curves.size(); ++i) {
      const double y = kTop + 4 + kLegendRow * static_cast<double>(i + 1);
      add("<g class=\"curve-{}\" color=\"{}\"><path d=\"M{},{}h18\" stroke=\"currentColor\" "
          "stroke-width=\"1.5\" stroke-dasharray=\"{}\"/>",
          i, colour(i), x, y - 4, dash(i));
      if (plot_.kind == sim::scenario::PlotKind::kPoints) {
        add("<path fill=\"currentColor\" transform=\"translate({},{})\" d=\"{}\"/>", x + 9, y - 4,
            symbol(i));
      }
      add("</g><text x=\"{}\" y=\"{}\">{}</text>\n", x + 24, y, escaped(plot_.curves[i].label));
    }
    add("</g>\n");
  }

  const Plot& plot_;
  Axis x_, y_;
  std::string out_;
};

}  // namespace

std::vector<double> ticks(double low, double high, int count) {
  if (!(high > low)) return {low};
  const double rough = (high - low) / count;
  const double power = hal::math::pow(10, std::floor(hal::math::log10(rough)));
  const double share = rough / power;
  const double step = power * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
  if (!std::isfinite(step) || !(step > 0)) return {low, high};  // below the resolution of binary64
  std::vector<double> values;
  const double first = std::ceil(low / step - 1e-9);
  const double room = std::floor(high / step + 1e-9) - first;
  const auto steps = static_cast<int>(std::clamp(room, 0.0, 2.0 * count));
  for (int i = 0; i <= steps; ++i) values.push_back((first + i) * step);
  return values;
}

std::string svg(const Plot& plot) { return Drawing(plot).text(); }

}  // namespace results::report
