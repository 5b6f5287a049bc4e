#include "sim/scenario/plot_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <stdexcept>

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

namespace {

/// A line "key: value" of a resolved scenario, which may begin a list item.
struct KeyLine {
  std::size_t indent = 0;
  bool is_item = false;
  std::string key, value;
};

std::optional<KeyLine> key_line(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(" -");
  if (begin == std::string::npos) return std::nullopt;
  const std::size_t colon = line.find(':', begin);
  if (colon == std::string::npos) return std::nullopt;
  const std::size_t indent = line.find_first_not_of(' ');
  KeyLine found{indent, line[indent] == '-', line.substr(begin, colon - begin), {}};
  const std::size_t first = line.find_first_not_of(" \"'", colon + 1);
  if (first == std::string::npos) return found;
  found.value = line.substr(first, line.find_last_not_of(" \"'") + 1 - first);
  return found;
}

}  // namespace

std::vector<std::string> observables_of(const std::string& resolved) {
  std::istringstream lines(resolved);
  std::vector<std::string> names;
  std::string line, section, list;
  while (std::getline(lines, line)) {
    const auto found = key_line(line);
    if (!found) continue;
    if (found->indent == 0) section = found->key;
    if (found->indent == 2 && !found->is_item) list = found->key;
    const bool is_in_list = section == "record" && list == "observables";
    if (is_in_list && found->key == "name") names.push_back(found->value);
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
