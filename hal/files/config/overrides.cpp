#include "hal/files/config/overrides.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "hal/files/config/document_limits.h"
#include "hal/files/config/yaml.h"

namespace hal::files::config {
namespace {

constexpr int kBeforeAllFiles = -1;

/// The parts of a dotted path; nullopt if one is empty.
std::optional<std::vector<std::string>> parts_of(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  for (const std::string& part : parts) {
    if (part.empty()) return std::nullopt;
  }
  return parts;
}

/// The value inside nested mappings, one for each part of its path.
Node nested(const std::vector<std::string>& parts, Node value) {
  const Place place = value.place;
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    Node mapping;
    mapping.kind = Node::Kind::kMapping;
    mapping.place = place;
    mapping.entries.push_back({*part, place, std::move(value)});
    value = std::move(mapping);
  }
  return value;
}

std::optional<Node> read_override(const std::string& text, Problems& problems,
                                  std::size_t& values_left) {
  Place place{.order = kBeforeAllFiles, .file = "--set " + text, .layer = Layer::kCommandLine};
  const std::size_t equals = text.find('=');
  const std::string path = text.substr(0, equals);
  const auto parts = parts_of(path);
  if (equals == std::string::npos || !parts) {
    problems.add(place, "", "must be KEY=VALUE, e.g. --set radio.tx_power='2 mW'");
    return std::nullopt;
  }
  place.file = "--set " + path;
  if (parts->size() > kMostParts) {
    problems.add(place, path,
                 fmt::format("has {} parts; at most {} are read", parts->size(), kMostParts));
    return std::nullopt;
  }
  std::vector<Problem> found;
  Node value = parse_yaml(text.substr(equals + 1), place, found, values_left);
  value.place = place;
  value.whole = true;
  const bool readable = found.empty();
  problems.add(std::move(found), "");
  if (!readable) return std::nullopt;
  return nested(*parts, std::move(value));
}

}  // namespace

Node read_overrides(const std::vector<std::string>& overrides, Problems& problems) {
  Node all;
  all.kind = Node::Kind::kMapping;
  all.place = {.order = kBeforeAllFiles, .file = "--set", .layer = Layer::kCommandLine};
  std::size_t values_left = kMostValues;
  for (const std::string& text : overrides) {
    if (auto one = read_override(text, problems, values_left))
      all = merged(std::move(all), std::move(*one));
  }
  return all;
}

}  // namespace hal::files::config
