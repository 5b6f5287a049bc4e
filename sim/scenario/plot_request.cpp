#include "sim/scenario/plot_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>

#include "hal/files/config/document_limits.h"
#include "hal/files/config/yaml.h"

namespace sim::scenario {
namespace {

/// @throws std::runtime_error  no option has this name
template <class E, std::size_t kSize>
E named(const std::array<hal::files::config::Option<E>, kSize>& options, const std::string& name) {
  for (const auto& option : options) {
    if (option.name == name) return option.value;
  }
  throw std::runtime_error(fmt::format("'{}' is neither a kind of plot nor of interval", name));
}

}  // namespace

std::string_view name_of(PlotKind kind) {
  return std::ranges::find(kPlotKinds, kind, &hal::files::config::Option<PlotKind>::value)->name;
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
    if (const std::string as = value(i, "as"); !as.empty()) request.as = named(kPlotKinds, as);
    if (const std::string interval = value(i, "interval"); !interval.empty())
      request.interval = named(kIntervalKinds, interval);
  }
  return requests;
}

std::vector<std::string> observables_in(const std::map<std::string, std::string>& settings) {
  std::vector<std::string> names;
  for (std::size_t i = 0;; ++i) {
    const auto found = settings.find(fmt::format("record.observables.{}.name", i));
    if (found == settings.end()) return names;
    names.push_back(found->second);
  }
}

std::vector<std::string> observables_of(const std::string& resolved) {
  using hal::files::config::Node;
  std::vector<hal::files::config::Problem> problems;
  std::size_t values_left = hal::files::config::kMostValues;
  const Node scenario = hal::files::config::parse_yaml(resolved, {}, problems, values_left);
  const auto* const record = scenario.find("record");
  const auto* const list = record == nullptr ? nullptr : record->value.find("observables");
  std::vector<std::string> names;
  if (list == nullptr) return names;
  names.reserve(list->value.items.size());
  for (const Node& item : list->value.items) {
    if (const auto* const name = item.find("name")) names.push_back(name->value.text);
  }
  return names;
}

bool is_for_the_report_only(std::string_view key) {
  return key == "compare" || key.starts_with("report.");
}

std::string without_report_only(const std::string& resolved) {
  std::istringstream lines(resolved);
  std::string kept, line;
  bool is_left_out = false;
  while (std::getline(lines, line)) {
    // Lines that belong to a key of the top level are indented, or are items of its list.
    const bool begins = !line.empty() && line.find_first_of(" -#") != 0;
    if (begins) {
      const std::string key = line.substr(0, line.find(':'));
      is_left_out = is_for_the_report_only(key) || is_for_the_report_only(key + ".");
    }
    if (!is_left_out) kept.append(line).append("\n");
  }
  return kept;
}

}  // namespace sim::scenario
