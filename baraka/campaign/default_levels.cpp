#include "baraka/campaign/default_levels.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "gateway/runtime/parameter_form.h"
#include "gateway/runtime/plugin.h"
#include "sim/scenario/resolved.h"

namespace baraka::campaign {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

/// Joins dotted paths and values into one YAML text: "{count: 4, spacing: [1 m, 2 m]}" from "count"
/// and "4", "spacing.0" and "1 m", ….
std::string in_one_line(const Values& values) {
  if (values.size() == 1 && values.front().first.empty()) return values.front().second;
  std::vector<std::pair<std::string, Values>> parts;
  for (const auto& [path, value] : values) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    const std::string head = path.substr(0, dot);
    if (parts.empty() || parts.back().first != head) parts.push_back({head, {}});
    parts.back().second.emplace_back(path.substr(std::min(dot + 1, path.size())), value);
  }
  const bool is_list = parts.front().first == "0";
  std::string text;
  for (const auto& [head, below] : parts) {
    text += (text.empty() ? "" : ", ") + (is_list ? "" : head + ": ") + in_one_line(below);
  }
  return is_list ? "[" + text + "]" : "{" + text + "}";
}

/// The default of a parameter "agents.GROUP.controller.parameters.NAME" that the scenario does not
/// give; "": there is none.
std::string parameter_default(const sim::scenario::Scenario& scenario, std::string_view key) {
  constexpr std::string_view kHead = "agents.";
  constexpr std::string_view kMiddle = ".controller.parameters.";
  const std::size_t middle = key.find(kMiddle);
  if (!key.starts_with(kHead) || middle == std::string_view::npos) return "";
  const std::string_view name = key.substr(middle + kMiddle.size());
  const auto group =
      std::ranges::find(scenario.groups, key.substr(kHead.size(), middle - kHead.size()),
                        &sim::scenario::Group::name);
  if (group == scenario.groups.end()) return "";
  const auto kind =
      gateway::runtime::load_plugin(group->program, gateway::runtime::controller_folders());
  if (!kind) return "";
  const auto& specs = (*kind)->parameters;
  const auto spec = std::ranges::find(specs, name, &hal::ParameterSpec::name);
  return spec == specs.end() ? "" : gateway::runtime::written(*spec, spec->default_value);
}

std::string value_in(const sim::scenario::Scenario& scenario, const Values& resolved,
                     const std::string& key) {
  Values below;
  for (const auto& [path, value] : resolved) {
    if (path == key) below.emplace_back("", value);
    if (path.starts_with(key + ".")) below.emplace_back(path.substr(key.size() + 1), value);
  }
  return below.empty() ? parameter_default(scenario, key) : in_one_line(below);
}

}  // namespace

std::vector<std::string> values_in(const sim::scenario::Scenario& scenario,
                                   const std::vector<std::string>& keys) {
  const Values resolved = sim::scenario::resolved_values(scenario);
  std::vector<std::string> values;
  values.reserve(keys.size());
  for (const std::string& key : keys) values.push_back(value_in(scenario, resolved, key));
  return values;
}

}  // namespace baraka::campaign
