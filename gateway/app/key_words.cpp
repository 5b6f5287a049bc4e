#include "gateway/app/key_words.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace gateway::app {

using hal::config::Condition;
using hal::config::Form;
using hal::config::KeyDescription;

std::string last_part(const std::string& path) { return path.substr(path.rfind('.') + 1); }

std::string mapping_of(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}

std::string value_words(const KeyDescription& key) {
  const std::string range = limits(key.form);
  return range.empty() ? expected(key.form) : fmt::format("{}, {}", expected(key.form), range);
}

std::string default_words(const KeyDescription& key) {
  const auto said = [&](const std::string& value) -> std::string {
    if (!value.empty()) return value;
    return key.optional ? "none" : std::string(hal::config::kMustBeGiven);
  };
  if (key.form.kind == Form::Kind::kMapping) return "";
  if (key.otherwise.size() == 1) return said(key.otherwise.front().value);
  std::vector<std::pair<std::string, std::vector<std::string>>> by_value;
  for (const KeyDescription::Otherwise& one : key.otherwise) {
    const std::string value = said(one.value);
    if (by_value.empty() || by_value.back().first != value) by_value.push_back({value, {}});
    by_value.back().second.push_back(one.with);
  }
  std::vector<std::string> parts;
  for (const auto& [value, with] : by_value) {
    parts.push_back(fmt::format("{} ({})", value, fmt::join(with, ", ")));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string condition_words(const KeyDescription& key) {
  std::vector<std::string> parts;
  for (const Condition& condition : key.conditions) {
    const bool beside = mapping_of(condition.path) == mapping_of(key.path);
    const std::string name = beside ? last_part(condition.path) : condition.path;
    if (condition.presence) {
      parts.push_back(
          fmt::format("{} `{}`", condition.values.front() == "there" ? "with" : "without", name));
    } else {
      parts.push_back(fmt::format("with `{}: {}`", name, fmt::join(condition.values, "` or `")));
    }
  }
  return parts.empty() ? "" : fmt::format("only {}", fmt::join(parts, ", "));
}

}  // namespace gateway::app
