#include "sim/report/plot_request.h"

#include <fmt/format.h>

#include <array>
#include <sstream>
#include <stdexcept>

namespace sim::report {
namespace {

constexpr std::array kKinds = {PlotKind::kAutomatic, PlotKind::kPoints, PlotKind::kTable,
                               PlotKind::kHistogram, PlotKind::kTime};

PlotKind kind_of(std::string_view name) {
  for (const PlotKind kind : kKinds) {
    if (name_of(kind) == name) return kind;
  }
  throw std::runtime_error(fmt::format("'{}' is no kind of plot", name));
}

}  // namespace

std::string_view name_of(PlotKind kind) {
  switch (kind) {
    case PlotKind::kPoints:
      return "points";
    case PlotKind::kTable:
      return "table";
    case PlotKind::kHistogram:
      return "histogram";
    case PlotKind::kTime:
      return "time";
    case PlotKind::kAutomatic:
      break;
  }
  return "automatic";
}

std::string_view name_of(IntervalKind kind) {
  return kind == IntervalKind::kBootstrap ? "bootstrap" : "student";
}

std::vector<PlotRequest> requests_in(const std::map<std::string, std::string>& settings) {
  const auto value = [&](std::size_t i, const char* key) {
    const auto found = settings.find(fmt::format("report.{}.{}", i, key));
    return found == settings.end() ? std::string() : found->second;
  };
  std::vector<PlotRequest> requests;
  for (std::size_t i = 0; !value(i, "plot").empty(); ++i) {
    PlotRequest& request = requests.emplace_back();
    request.plot = value(i, "plot");
    request.versus = value(i, "versus");
    request.by = value(i, "by");
    request.agent = value(i, "agent");
    if (value(i, "interval") == "bootstrap") request.interval = IntervalKind::kBootstrap;
    if (const std::string as = value(i, "as"); !as.empty()) request.as = kind_of(as);
  }
  return requests;
}

bool is_for_the_report_only(std::string_view key) {
  return key == "compare" || key.starts_with("report.");
}

std::string without_report_only(const std::string& resolved) {
  std::istringstream lines(resolved);
  std::string kept, line;
  bool is_left_out = false;
  while (std::getline(lines, line)) {
    // What belongs to a key of the top level is indented, or an item of its list.
    const bool begins = !line.empty() && line.find_first_of(" -#") != 0;
    if (begins) {
      const std::string key = line.substr(0, line.find(':'));
      is_left_out = is_for_the_report_only(key) || is_for_the_report_only(key + ".");
    }
    if (!is_left_out) kept.append(line).append("\n");
  }
  return kept;
}

}  // namespace sim::report
