#include "results/report/chart_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace results::report {
namespace {

constexpr double kBarOpacity = 0.6, kSpanOpacity = 0.2;
constexpr double kTextSize = 10;  // px

Stroke stroke_of(const Chart::Style& style) { return {style.dash, style.width, style.opacity}; }

double clamped(const Axis& axis, double value) { return std::clamp(value, axis.low, axis.high); }

/// Collects the entries; a line and marks of the same label are one.
struct LegendEntries {
  std::vector<Drawing::Entry> entries{};

  Drawing::Entry* entry_of(const Chart::Style& style) {
    if (style.label.empty()) return nullptr;
    const auto same = std::find_if(entries.begin(), entries.end(), [&](const Drawing::Entry& one) {
      return one.label == style.label;
    });
    if (same != entries.end()) return &*same;
    return &entries.emplace_back(
        Drawing::Entry{.curve = style.curve, .label = style.label, .has_line = false});
  }
  void add_line(const Chart::Style& style) {
    Drawing::Entry* entry = entry_of(style);
    if (entry == nullptr) return;
    entry->has_line = true;
    entry->stroke = stroke_of(style);
  }
  void add_box(const Chart::Style& style, double opacity) {
    if (Drawing::Entry* entry = entry_of(style)) entry->box_opacity = opacity;
  }

  void operator()(const Chart::Line& line) { add_line(line.style); }
  void operator()(const Chart::Marks& marks) {
    if (Drawing::Entry* entry = entry_of(marks.style)) entry->symbol = marks.symbol;
  }
  void operator()(const Chart::Bars& bars) {
    for (const Chart::Bars::Series& series : bars.series) add_box(series.style, kBarOpacity);
  }
  void operator()(const Chart::Reference& line) { add_line(line.style); }
  void operator()(const Chart::Span& span) { add_box(span.style, kSpanOpacity); }
  void operator()(const Chart::Text&) {}
};

}  // namespace

/// Whether a mark there is drawn; if not, it is counted.
bool LayerDrawing::counts_as_shown(double x, double y) {
  if (!frame_.x.is_drawable(x) || !frame_.y.is_drawable(y)) {
    ++without_position_;
    return false;
  }
  if (frame_.x.holds(x) && frame_.y.holds(y)) return true;
  ++outside_;
  return false;
}

std::string LayerDrawing::path_of(const Chart::Line& line) {
  const auto is_drawable = [&](std::size_t i) {
    return i < line.x.size() && frame_.x.is_drawable(line.x[i]) && frame_.y.is_drawable(line.y[i]);
  };
  std::string path;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (!is_drawable(i)) {
      ++without_position_;
      continue;
    }
    const double x = frame_.x.at(line.x[i]);
    const double y = frame_.y.at(line.y[i]);
    const bool continues = i > 0 && is_drawable(i - 1);
    if (continues) {
      path +=
          fmt::format(fmt::runtime(line.is_stepped ? "H{:.2f}V{:.2f}" : "L{:.2f},{:.2f}"), x, y);
    } else if (is_drawable(i + 1)) {
      path += fmt::format("M{:.2f},{:.2f}", x, y);
    } else {  // alone: a square
      path += fmt::format("M{:.2f},{:.2f}h{}", x - line.style.width / 2, y, line.style.width);
    }
  }
  return path;
}

void LayerDrawing::operator()(const Chart::Line& line) {
  const std::string path = path_of(line);
  if (path.empty()) return;
  bool is_within = false;
  std::size_t drawable = 0;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    is_within |= frame_.x.holds(line.x[i]) && frame_.y.holds(line.y[i]);
    drawable += frame_.x.is_drawable(line.x[i]) && frame_.y.is_drawable(line.y[i]);
  }
  if (!is_within) outside_ += drawable;
  out_.open_curve(line.style.curve);
  out_.open_clip(frame_);
  out_.line(path, stroke_of(line.style));
  out_.close_clip();
  out_.close();
}

void LayerDrawing::draw_interval(double x, double low, double high) {
  if (!std::isfinite(low) || !std::isfinite(high)) {
    ++without_position_;
    return;
  }
  const Axis& y = frame_.y;
  if (high < y.low || low > y.high) return;  // its mark is counted
  out_.interval(frame_.x.at(x), y.at(clamped(y, low)), y.at(clamped(y, high)), y.holds(low),
                y.holds(high));
}

void LayerDrawing::operator()(const Chart::Marks& marks) {
  if (marks.x.empty()) return;
  out_.open_curve(marks.style.curve);
  for (std::size_t i = 0; i < marks.x.size(); ++i) {
    if (!counts_as_shown(marks.x[i], marks.y[i])) continue;
    if (!marks.low.empty()) draw_interval(marks.x[i], marks.low[i], marks.high[i]);
    out_.point(frame_.x.at(marks.x[i]), frame_.y.at(marks.y[i]), marks.symbol, {},
               {marks.scale, marks.style.opacity});
  }
  out_.close();
}

void LayerDrawing::draw_bar(const Chart::Bars& bars, std::size_t series, std::size_t i) {
  const BarEnds ends = ends_of(bars, series, i);
  const Axis& y = frame_.y;
  const double beside = bars.is_stacked ? 1 : static_cast<double>(bars.series.size());
  const double width = bars.width / beside;
  const double left =
      bars.at[i] - bars.width / 2 + (bars.is_stacked ? 0 : width * static_cast<double>(series));
  const double from = y.is_log ? std::max(y.low, ends.from) : ends.from;
  if (!counts_as_shown(left + width / 2, ends.to) && !y.is_drawable(ends.to)) return;
  const double low = clamped(y, std::min(from, ends.to));
  const double high = clamped(y, std::max(from, ends.to));
  const double begin = clamped(frame_.x, left);
  const double end = clamped(frame_.x, left + width);
  if (!(begin < end)) return;  // counted
  const Box box{frame_.x.at(begin), y.at(high), frame_.x.at(end) - frame_.x.at(begin),
                y.at(low) - y.at(high)};
  out_.bin(box, kBarOpacity, {"", fmt::format("{:.6g}", bars.series[series].y[i])});
  if (y.holds(ends.to)) draw_above(left + width / 2, ends.to, bars.series[series], i);
}

/// What is at the end of a bar: its interval and its text.
void LayerDrawing::draw_above(double x, double y, const Chart::Bars::Series& series,
                              std::size_t i) {
  const bool has_interval = !series.low.empty();
  if (has_interval) draw_interval(x, series.low[i], series.high[i]);
  if (series.texts.empty()) return;
  const double above = has_interval ? clamped(frame_.y, std::max(y, series.high[i])) : y;
  out_.words(series.texts[i],
             fmt::format(" class=\"value\" text-anchor=\"middle\" font-size=\"{}\" "
                         "fill=\"#222\" x=\"{:.2f}\" y=\"{:.2f}\"",
                         kTextSize, frame_.x.at(x), frame_.y.at(above) - 4));
}

void LayerDrawing::operator()(const Chart::Bars& bars) {
  for (std::size_t series = 0; series < bars.series.size(); ++series) {
    out_.open_curve(bars.series[series].style.curve);
    for (std::size_t i = 0; i < bars.at.size(); ++i) draw_bar(bars, series, i);
    out_.close();
  }
}

void LayerDrawing::operator()(const Chart::Reference& line) {
  const Axis& axis = line.is_upright ? frame_.x : frame_.y;
  if (!axis.holds(line.at)) {
    ++(axis.is_drawable(line.at) ? outside_ : without_position_);
    return;
  }
  const double at = axis.at(line.at);
  out_.open_curve(line.style.curve);
  out_.line(line.is_upright
                ? fmt::format("M{:.2f},{:.2f}V{:.2f}", at, frame_.bottom(), frame_.top())
                : fmt::format("M{:.2f},{:.2f}H{:.2f}", frame_.left(), at, frame_.right()),
            stroke_of(line.style));
  out_.close();
}

void LayerDrawing::operator()(const Chart::Span& span) {
  const Axis& x = frame_.x;
  if (!x.is_drawable(span.from) || !x.is_drawable(span.to)) {
    ++without_position_;
    return;
  }
  const double from = clamped(x, std::min(span.from, span.to));
  const double to = clamped(x, std::max(span.from, span.to));
  if (!(from < to)) {
    ++outside_;
    return;
  }
  out_.open_curve(span.style.curve);
  out_.area(fmt::format("M{:.2f},{:.2f}V{:.2f}H{:.2f}V{:.2f}Z", x.at(from), frame_.bottom(),
                        frame_.top(), x.at(to), frame_.bottom()),
            kSpanOpacity);
  out_.close();
}

void LayerDrawing::operator()(const Chart::Text& text) {
  if (!counts_as_shown(text.x, text.y)) return;
  out_.open_curve(text.style.curve);
  out_.words(text.text,
             fmt::format(" class=\"remark\" text-anchor=\"end\" font-size=\"{0}\" "
                         "fill=\"currentColor\" transform=\"translate({1:.2f},{2:.2f}) "
                         "rotate(-90)\"",
                         kTextSize, frame_.x.at(text.x) + kTextSize, frame_.y.at(text.y)));
  out_.close();
}

std::string LayerDrawing::note() const {
  std::string text;
  if (outside_ > 0) text = fmt::format("{} outside the limits", outside_);
  if (without_position_ > 0) {
    text += fmt::format("{}{} without a position", text.empty() ? "" : ", ", without_position_);
  }
  return text.empty() ? "" : "not shown: " + text;
}

std::vector<Drawing::Entry> legend_of(const Chart::Panel& panel) {
  LegendEntries found;
  for (const Chart::Layer& layer : panel.layers) std::visit(found, layer);
  return found.entries;
}

}  // namespace results::report
