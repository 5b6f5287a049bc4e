#include "results/report/plot_json.h"

#include <nlohmann/json.hpp>

namespace results::report {
namespace {

using FigureJson = nlohmann::ordered_json;

FigureJson or_null(const std::optional<double>& value) {
  return value ? FigureJson(*value) : FigureJson(nullptr);
}

FigureJson mark_json(const Plot::Mark& mark, const Plot& plot) {
  FigureJson json = {{"x", mark.x}, {"setting", nullptr}, {"y", mark.y}};
  if (!plot.categories.empty()) {
    json["setting"] = plot.categories.at(static_cast<std::size_t>(mark.x));
  } else if (!mark.x_text.empty()) {
    json["setting"] = mark.x_text;
  }
  json["low"] = mark.interval ? FigureJson(mark.interval->low) : FigureJson(nullptr);
  json["high"] = mark.interval ? FigureJson(mark.interval->high) : FigureJson(nullptr);
  json["sd"] = mark.count > 1 ? FigureJson(mark.sd) : FigureJson(nullptr);
  json["count"] = mark.count;
  json["width"] = mark.width;
  return json;
}

FigureJson difference_json(const PairedDifference& one) {
  return {{"setting", one.setting},
          {"pairs", one.pairs.difference.count},
          {"difference", one.pairs.difference.mean},
          {"low", one.pairs.interval.low},
          {"high", one.pairs.interval.high},
          {"p", or_null(one.pairs.p)},
          {"correlation", or_null(one.pairs.correlation)}};
}

std::string interval_name(const Plot& plot) {
  if (plot.interval == sim::scenario::IntervalKind::kBootstrap) return "BCa bootstrap";
  return std::string(name_of_interval(plot.support));
}

}  // namespace

std::string plot_json(const Plot& plot, const std::string& first,
                      const std::vector<PairedDifference>& differences) {
  FigureJson json = {{"name", plot.name},
                     {"title", plot.title},
                     {"kind", sim::scenario::name_of(plot.kind)},
                     {"x_label", plot.x_label},
                     {"y_label", plot.y_label},
                     {"curves_are", plot.curves_are},
                     {"interval", interval_name(plot)},
                     {"level", statistics::kLevel},
                     {"notes", plot.notes},
                     {"curves", FigureJson::array()},
                     {"first", first},
                     {"differences", FigureJson::array()}};
  for (const Plot::Curve& curve : plot.curves) {
    FigureJson marks = FigureJson::array();
    for (const Plot::Mark& mark : curve.marks) marks.push_back(mark_json(mark, plot));
    json["curves"].push_back({{"label", curve.label}, {"marks", std::move(marks)}});
  }
  for (const PairedDifference& one : differences) {
    json["differences"].push_back(difference_json(one));
  }
  // Names of folders may be in any encoding.
  return json.dump(-1, ' ', false, FigureJson::error_handler_t::replace) + "\n";
}

}  // namespace results::report
