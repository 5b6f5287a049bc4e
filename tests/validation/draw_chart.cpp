// Draws a chart for the figures of docs/: reads it as JSON from stdin and writes SVG to stdout.
// document.py makes the JSON; keys are the members of results::report::Chart, null among numbers is
// a value that is not finite. What is wrong with the JSON is said with its place, and exits with 1.

#include <fmt/format.h>

#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "results/report/chart.h"

namespace {

using Json = nlohmann::json;
using results::report::Chart;

/// An object of which every key has to be asked for.
class Object {
 public:
  Object(const Json& json, std::string place) : json_(json), place_(std::move(place)) {
    if (!json.is_object()) fail("", "is no object");
  }

  template <class T>
  void read(const char* key, T& to) {
    if (const Json* value = find(key)) to = as<T>(*value, key);
  }
  void read(const char* key, std::optional<double>& to) {
    const Json* value = find(key);
    if (value != nullptr && !value->is_null()) to = as<double>(*value, key);
  }
  void read(const char* key, std::vector<double>& to) {
    const Json* values = find(key);
    if (values == nullptr) return;
    if (!values->is_array()) fail(key, "is no list");
    to.reserve(values->size());
    for (const Json& one : *values)
      to.push_back(one.is_null() ? std::numeric_limits<double>::quiet_NaN() : as<double>(one, key));
  }
  template <class T>
  T needed(const char* key) {
    const Json* value = find(key);
    if (value == nullptr) fail(key, "is missing");
    return as<T>(*value, key);
  }

  /// Calls use(object) for each object of a list.
  template <class Use>
  void each(const char* key, Use use) {
    const Json* list = find(key);
    if (list == nullptr) return;
    if (!list->is_array()) fail(key, "is no list");
    for (std::size_t i = 0; i < list->size(); ++i) {
      Object one((*list)[i], fmt::format("{}{}[{}].", place_, key, i));
      use(one);
      one.finish();
    }
  }
  /// Calls use(object) for an object, if it is there.
  template <class Use>
  void inside(const char* key, Use use) {
    const Json* value = find(key);
    if (value == nullptr) return;
    Object one(*value, fmt::format("{}{}.", place_, key));
    use(one);
    one.finish();
  }

  void finish() const {
    for (const auto& [key, value] : json_.items()) {
      if (!asked_.contains(key)) fail(key, "is no key here");
    }
  }
  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    std::string place = place_ + key;
    if (key.empty()) place = place_.empty() ? "chart" : place_.substr(0, place_.size() - 1);
    throw std::invalid_argument(fmt::format("{}: {}", place, what));
  }

 private:
  const Json* find(const char* key) {
    asked_.insert(key);
    const auto found = json_.find(key);
    return found == json_.end() ? nullptr : &*found;
  }
  template <class T>
  T as(const Json& value, const char* key) const {
    try {
      return value.get<T>();
    } catch (const Json::exception&) {
      fail(key, fmt::format("{} is of the wrong type", value.dump()));
    }
  }

  const Json& json_;
  std::string place_;
  std::set<std::string> asked_;
};

const char* dash_named(Object& in) {
  std::string name = "solid";
  in.read("dash", name);
  if (name == "solid") return "none";
  if (name == "dashed") return "6 3";
  if (name == "dotted") return "2 2";
  in.fail("dash", fmt::format("'{}' is none of solid, dashed, dotted", name));
}

Chart::Style style_of(Object& in) {
  Chart::Style style;
  in.read("label", style.label);
  in.read("curve", style.curve);
  in.read("stroke", style.width);
  in.read("opacity", style.opacity);
  style.dash = dash_named(in);
  return style;
}

Chart::Line line_of(Object& in) {
  Chart::Line line{.style = style_of(in)};
  in.read("x", line.x);
  in.read("y", line.y);
  in.read("is_stepped", line.is_stepped);
  return line;
}

Chart::Marks marks_of(Object& in) {
  Chart::Marks marks{.style = style_of(in)};
  in.read("x", marks.x);
  in.read("y", marks.y);
  in.read("low", marks.low);
  in.read("high", marks.high);
  in.read("scale", marks.scale);
  std::string shape = "circle";
  in.read("shape", shape);
  if (shape == "cross") {
    marks.symbol = results::report::kCross;
  } else if (shape == "plus") {
    marks.symbol = results::report::kPlus;
  } else if (shape != "circle") {
    in.fail("shape", fmt::format("'{}' is none of circle, cross, plus", shape));
  }
  return marks;
}

Chart::Bars bars_of(Object& in) {
  Chart::Bars bars;
  in.read("at", bars.at);
  in.read("width", bars.width);
  in.read("is_stacked", bars.is_stacked);
  in.each("series", [&](Object& one) {
    Chart::Bars::Series& series = bars.series.emplace_back();
    series.style = style_of(one);
    one.read("y", series.y);
    one.read("low", series.low);
    one.read("high", series.high);
    one.read("texts", series.texts);
  });
  return bars;
}

Chart::Layer layer_of(Object& in) {
  const auto kind = in.needed<std::string>("kind");
  if (kind == "line") return line_of(in);
  if (kind == "marks") return marks_of(in);
  if (kind == "bars") return bars_of(in);
  if (kind == "reference") {
    Chart::Reference line{.style = style_of(in), .at = in.needed<double>("at")};
    in.read("is_upright", line.is_upright);
    return line;
  }
  if (kind == "span") {
    return Chart::Span{style_of(in), in.needed<double>("from"), in.needed<double>("to")};
  }
  if (kind == "text") {
    return Chart::Text{style_of(in), in.needed<double>("x"), in.needed<double>("y"),
                       in.needed<std::string>("text")};
  }
  in.fail("kind", fmt::format("'{}' is none of line, marks, bars, reference, span, text", kind));
}

void read_scale(Object& in, Chart::Scale& scale) {
  in.read("label", scale.label);
  in.read("is_log", scale.is_log);
  in.read("low", scale.low);
  in.read("high", scale.high);
  in.read("ticks", scale.ticks);
  in.read("names", scale.names);
}

Chart chart_of(const Json& json) {
  Chart chart;
  Object in(json, "");
  in.read("title", chart.title);
  in.read("width", chart.width);
  in.read("height", chart.height);
  in.read("columns", chart.columns);
  in.read("shares_x", chart.shares_x);
  in.read("shares_y", chart.shares_y);
  in.each("panels", [&](Object& one) {
    Chart::Panel& panel = chart.panels.emplace_back();
    one.read("title", panel.title);
    one.inside("x", [&](Object& scale) { read_scale(scale, panel.x); });
    one.inside("y", [&](Object& scale) { read_scale(scale, panel.y); });
    one.each("layers", [&](Object& layer) { panel.layers.push_back(layer_of(layer)); });
  });
  in.finish();
  return chart;
}

}  // namespace

int main() try {
  std::cout << svg(chart_of(Json::parse(std::cin)));
  return 0;
} catch (const std::exception& e) {
  std::cerr << "draw_chart: " << e.what() << "\n";
  return 1;
}
