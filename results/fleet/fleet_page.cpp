#include "results/fleet/fleet_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "results/fleet/fleet_text.h"
#include "results/report/drawing.h"
#include "results/report/plot.h"
#include "results/report/svg.h"

namespace results::fleet {
namespace {

using report::escaped;

constexpr const char* kStyle =
    "body{font:15px/1.45 sans-serif;max-width:72rem;margin:2rem auto;padding:0 1rem;color:#222}"
    "table{border-collapse:collapse;margin:.8rem 0;display:block;overflow-x:auto}"
    "th,td{padding:.2rem .6rem;text-align:right;border-bottom:1px solid #ddd;white-space:nowrap}"
    "th:first-child,td:first-child,.words td,.words th{text-align:left}"
    ".words td{white-space:normal}"
    "pre{background:#f4f4f4;padding:.8rem;overflow-x:auto}"
    "figure{display:inline-block;margin:.5rem 1rem .5rem 0}";

std::string table(const Cells& cells, const char* look = "") {
  const auto row = [](const std::vector<std::string>& texts, const char* tag) {
    std::string line = "<tr>";
    for (const std::string& text : texts) {
      line += fmt::format("<{0}>{1}</{0}>", tag, escaped(text));
    }
    return line + "</tr>\n";
  };
  std::string text = fmt::format("<table class=\"{}\">\n{}", look, row(cells.head, "th"));
  for (const auto& one : cells.rows) text += row(one, "td");
  return text + "</table>\n";
}

/// One quantity of all topics against the number of robots.
struct CurveKind {
  const char* name;
  const char* title;
  const char* unit;
  std::optional<Estimate> SampleAnswer::*value;
  double factor;
  statistics::Support::Kind support;
};

constexpr auto kTime = statistics::Support::Kind::kNotNegative;
constexpr std::array kQuantities = {
    CurveKind{"delivered", "delivered samples", "%", &SampleAnswer::delivered, 100,
              statistics::Support::Kind::kShare},
    CurveKind{"p95", "latency, 95 % quantile", "ms", &SampleAnswer::p95, 1000, kTime},
    CurveKind{"age", "age of the newest sample, in 95 % of the time", "ms", &SampleAnswer::age,
              1000, kTime}};

report::Plot::Mark mark_of(const CaseAnswer& one, const Estimate& value, double factor) {
  report::Plot::Mark mark;
  mark.x = one.which.robots;
  mark.x_text = std::to_string(one.which.robots);
  mark.y = factor * value.value;
  if (value.interval) {
    mark.interval = {factor * value.interval->low, factor * value.interval->high};
  }
  mark.count = value.runs;
  return mark;
}

std::string figure(const FleetLine& line, const CurveKind& quantity) {
  report::Plot plot;
  plot.name = quantity.name;
  plot.title = quantity.title;
  plot.x_label = "robots";
  plot.y_label = fmt::format("{}, {}", quantity.title, quantity.unit);
  plot.curves_are = "topic";
  plot.support = quantity.support;
  for (const CaseAnswer& one : line.cases) {
    for (const auto& [topic, samples] : one.topics) {
      const std::optional<Estimate>& value = samples.*quantity.value;
      if (!value) continue;
      auto curve = std::ranges::find(plot.curves, topic, &report::Plot::Curve::label);
      if (curve == plot.curves.end()) {
        plot.curves.push_back({topic, {}});
        curve = std::prev(plot.curves.end());
      }
      curve->marks.push_back(mark_of(one, *value, quantity.factor));
    }
  }
  if (plot.curves.empty()) return "";
  return fmt::format("<figure>{}</figure>\n", report::svg(plot));
}

/// A text with its line ends, for `pre`.
std::string preformatted(const std::string& text) {
  std::string all;
  for (const char c : text) {
    if (c == '\n' || c == '\t') {
      all += c;
    } else if (c != '\r') {
      all += escaped(std::string(1, c));
    }
  }
  return all;
}

/// When the shortest run ended [s]; the file's `until` if there is none.
double end_of(const FleetFile& fleet, const std::vector<FleetLine>& lines) {
  double end = hal::to_seconds(fleet.until);
  for (const FleetLine& line : lines) {
    for (const CaseAnswer& one : line.cases) end = std::min(end, one.ended_s.value_or(end));
  }
  return end;
}

/// The best profile of each radio and site that has a file, each file once.
std::string profiles(const FleetFile& fleet, const std::vector<FleetLine>& lines) {
  std::vector<std::size_t> shown;
  std::string text;
  for (std::size_t radio = 0; radio < fleet.radios.size(); ++radio) {
    for (std::size_t site = 0; site < fleet.sites.size(); ++site) {
      const auto ranking = ranked(lines, radio, site);
      if (ranking.empty()) continue;
      const std::size_t best = ranking.front()->profile;
      const Variant& profile = fleet.profiles[best];
      if (!profile.xml || std::ranges::find(shown, best) != shown.end()) continue;
      shown.push_back(best);
      text += fmt::format("<h2>Profile {}</h2>\n<pre>{}</pre>\n", escaped(profile.name),
                          preformatted(xml_of(profile)));
    }
  }
  return text;
}

}  // namespace

std::string fleet_page(const FleetFile& fleet, const std::vector<FleetLine>& lines) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>\n"
      "<style>{1}</style></head><body>\n<h1>{0}</h1>\n",
      escaped(fleet.name), kStyle);
  for (const std::string& one : sentences(fleet, lines)) {
    text += fmt::format("<p>{}</p>\n", escaped(one));
  }
  text += table(summary_cells(fleet, lines), "words");
  text += fmt::format(
      "<p>Samples sent from {} s to {} s; means over the runs, and latencies of the samples of "
      "all runs together, with 95 % intervals. What is on the air, of the whole runs.</p>\n",
      hal::to_seconds(fleet.warm_up), end_of(fleet, lines));
  text += profiles(fleet, lines);
  for (const FleetLine& line : lines) {
    const std::string words = words_of(fleet, {line.radio, line.site, line.profile});
    text += fmt::format("<h2>{}</h2>\n", words.empty() ? "Topics" : escaped(words));
    for (const CurveKind& quantity : kQuantities) text += figure(line, quantity);
    text += table(topic_cells(line, Intervals::kShown)) + table(air_cells(line, Intervals::kShown));
  }
  return text + "</body></html>\n";
}

}  // namespace results::fleet
