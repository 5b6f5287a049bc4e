#include "baraka/commands/key_words.h"

#include <fmt/format.h>

#include <functional>
#include <utility>
#include <vector>

namespace baraka::commands {

using hal::files::config::Condition;
using hal::files::config::Form;
using hal::files::config::KeyDescription;

std::string last_part(const std::string& path) { return path.substr(path.rfind('.') + 1); }

std::string mapping_of(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}

namespace {

/// "7 (disk), 31 (ideal)", or a single text if all are equal.
std::string by_variant(const KeyDescription& key,
                       const std::function<std::string(const KeyDescription::Variant&)>& words) {
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;
  for (const KeyDescription::Variant& variant : key.variants) {
    const std::string said = words(variant);
    if (groups.empty() || groups.back().first != said) groups.push_back({said, {}});
    groups.back().second.push_back(variant.with);
  }
  if (groups.size() == 1) return groups.front().first;
  std::vector<std::string> parts;
  parts.reserve(groups.size());
  for (const auto& [said, with] : groups) {
    parts.push_back(fmt::format("{} ({})", said, fmt::join(with, ", ")));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

std::string value_words(const KeyDescription& key) {
  const std::string range = by_variant(key, [](const auto& variant) { return variant.limits; });
  return range.empty() ? expected(key.form) : fmt::format("{}, {}", expected(key.form), range);
}

std::string default_words(const KeyDescription& key) {
  if (key.form.kind == Form::Kind::kMapping) return "";
  return by_variant(key, [&](const KeyDescription::Variant& variant) -> std::string {
    if (!variant.otherwise.empty()) return variant.otherwise;
    return key.optional ? "none" : std::string(hal::files::config::kMustBeGiven);
  });
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

}  // namespace baraka::commands
