#include "results/report/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "results/report/chart_layers.h"

namespace results::report {
namespace {

constexpr double kTitleRow = 20, kEntryRow = 18;  // px
constexpr double kEntryGap = 16, kSample = 24;    // px: between entries; before a text
constexpr double kLabelRow = 22;                  // px, for the name of an axis
constexpr double kEdge = 10;                      // px, around a panel
constexpr double kPerXTick = 70, kPerYTick = 40;  // px
constexpr double kLeastArea = 40;                 // px, of the sides of a panel's frame
constexpr double kSlant = 0.71;                   // sine and cosine of 45 degrees

struct Tick {
  double value = 0;
  std::string text;
};

std::vector<Tick> ticks_of(const Chart::Scale& scale, const Axis& axis, double count) {
  std::vector<Tick> result;
  for (std::size_t i = 0; i < scale.names.size(); ++i)
    result.push_back({static_cast<double>(i), scale.names[i]});
  if (!result.empty()) return result;
  const int about = std::max(2, static_cast<int>(count));
  std::vector<double> values = scale.ticks;
  if (values.empty())
    values =
        axis.is_log ? log_ticks(axis.low, axis.high, about) : ticks(axis.low, axis.high, about);
  for (const double value : values) {
    if (axis.holds(value)) result.push_back({value, fmt::format("{:g}", value)});
  }
  return result;
}

double widest(const std::vector<Tick>& ticks) {
  double width = 0;
  for (const Tick& tick : ticks) width = std::max(width, width_of(tick.text));
  return width;
}

double entry_width(const Drawing::Entry& entry) {
  return kSample + width_of(entry.label) + kEntryGap;
}

/// Entries of a legend in lines that are no wider than this, px.
std::vector<std::vector<Drawing::Entry>> lines_of(std::vector<Drawing::Entry> entries,
                                                  double width) {
  std::vector<std::vector<Drawing::Entry>> lines;
  double used = width;
  for (Drawing::Entry& entry : entries) {
    if (lines.empty() || used + entry_width(entry) - kEntryGap > width) {
      lines.emplace_back();
      used = 0;
    }
    used += entry_width(entry);
    lines.back().push_back(std::move(entry));
  }
  return lines;
}

/// A panel with all that its size depends on.
struct LaidOut {
  const Chart::Panel* panel = nullptr;
  Limits limits{};
  std::vector<Tick> x_ticks{}, y_ticks{};
  std::vector<std::vector<Drawing::Entry>> legend{};
  bool is_slanted = false;  ///< The texts along x.
};

/// Places the panels so that their frames are equal in size.
class ChartDrawing {
 public:
  explicit ChartDrawing(const Chart& chart) : chart_(chart) {
    if (chart.panels.empty() || chart.columns == 0)
      throw std::invalid_argument("there is no panel");
    const std::size_t rows = (chart.panels.size() + chart.columns - 1) / chart.columns;
    cell_width_ = chart.width / static_cast<double>(chart.columns);
    cell_height_ = chart.height / static_cast<double>(rows);
    const std::vector<Limits> limits = limits_of(chart);
    for (std::size_t i = 0; i < limits.size(); ++i) {
      const Chart::Panel& panel = chart.panels[i];
      panels_.push_back(
          {&panel, limits[i], {}, ticks_of(panel.y, limits[i].y, cell_height_ / kPerYTick)});
    }
    measure_sides();
    measure_ends();
    if (width_ < kLeastArea || height_ < kLeastArea)
      throw std::invalid_argument("the panels are too small for their texts");
  }

  std::string text() {
    out_.background(chart_.width, chart_.height);
    for (std::size_t i = 0; i < panels_.size(); ++i) draw(panels_[i], frame_of(i));
    return out_.document(chart_.width, chart_.height, chart_.title);
  }

 private:
  void measure_sides() {
    for (const LaidOut& one : panels_) {
      const double label = one.panel->y.label.empty() ? 0 : kLabelRow;
      left_ = std::max(left_, std::ceil(label + widest(one.y_ticks) + kEdge));
    }
    width_ = std::floor(cell_width_ - left_ - kEdge);
  }

  void measure_ends() {
    double bottom = 0;
    for (LaidOut& one : panels_) {
      one.x_ticks = ticks_of(one.panel->x, one.limits.x, width_ / kPerXTick);
      const double wide = widest(one.x_ticks);
      one.is_slanted =
          !one.panel->x.names.empty() && wide * static_cast<double>(one.x_ticks.size()) > width_;
      one.legend = lines_of(legend_of(*one.panel), width_ + kEdge);
      legend_height_ = std::max(legend_height_, kEntryRow * static_cast<double>(one.legend.size()));
      if (!one.panel->title.empty()) title_height_ = kTitleRow;
      below_ticks_ = std::max(below_ticks_, one.is_slanted ? std::ceil(wide * kSlant) + 20 : 24);
      if (!one.panel->x.label.empty()) bottom = kLabelRow;
    }
    bottom += below_ticks_;
    height_ = std::floor(cell_height_ - bottom - kEdge - title_height_ - legend_height_);
  }

  Frame frame_of(std::size_t i) const {
    const double left = std::floor(cell_width_ * static_cast<double>(i % chart_.columns)) + left_;
    const std::size_t row = i / chart_.columns;
    const double top = std::floor(cell_height_ * static_cast<double>(row)) + kEdge + title_height_ +
                       legend_height_;
    Frame frame{panels_[i].limits.x, panels_[i].limits.y};
    frame.x.from = left;
    frame.x.to = left + width_;
    frame.y.from = top + height_;
    frame.y.to = top;
    return frame;
  }

  void draw(const LaidOut& one, const Frame& frame) {
    for (const Tick& tick : one.y_ticks) out_.y_tick(frame, tick.value, tick.text);
    for (const Tick& tick : one.x_ticks) out_.x_tick(frame, tick.value, tick.text, one.is_slanted);
    LayerDrawing layers(out_, frame);
    for (const Chart::Layer& layer : one.panel->layers) std::visit(layers, layer);
    out_.axes(frame);
    out_.axis_labels(frame, one.panel->x.label, below_ticks_ + 12, one.panel->y.label, left_ - 14);
    draw_legend(one, frame);
    if (!one.panel->title.empty()) {
      out_.words(one.panel->title,
                 fmt::format(" class=\"title\" font-weight=\"bold\" x=\"{}\" y=\"{}\"",
                             frame.left(), frame.top() - legend_height_ - 8));
    }
    const std::string note = layers.note();
    if (note.empty()) return;
    out_.words(note, fmt::format(" class=\"note\" text-anchor=\"end\" font-size=\"10\" "
                                 "fill=\"#a00000\" x=\"{}\" y=\"{}\"",
                                 frame.right() - 4, frame.top() + 12));
  }

  void draw_legend(const LaidOut& one, const Frame& frame) {
    if (one.legend.empty()) return;
    out_.open_legend();
    double y = frame.top() - 6 - kEntryRow * static_cast<double>(one.legend.size() - 1);
    for (const auto& line : one.legend) {
      double x = frame.left();
      for (const Drawing::Entry& entry : line) {
        out_.legend_entry(x, y, entry);
        x += entry_width(entry);
      }
      y += kEntryRow;
    }
    out_.close();
  }

  const Chart& chart_;
  std::vector<LaidOut> panels_;
  double cell_width_ = 0, cell_height_ = 0;   // px, of a panel with its texts
  double left_ = 0, width_ = 0, height_ = 0;  // px, of its frame
  double title_height_ = 0, legend_height_ = 0, below_ticks_ = 0;
  Drawing out_;
};

}  // namespace

std::string svg(const Chart& chart) {
  check_columns(chart);
  return ChartDrawing(chart).text();
}

}  // namespace results::report
