#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "hal/files/config/yaml.h"

namespace hal::files::config {
namespace {

/// Whether a scalar keeps its meaning without quotation marks, also inside a list.
bool is_plain(std::string_view text) {
  constexpr std::string_view kInside = "_./+-^()%", kFirst = "_./+-";
  const auto is_word = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  const auto may_stand = [&](char c) {
    return is_word(c) || c == ' ' || kInside.find(c) != std::string_view::npos;
  };
  if (text.empty() || text.back() == ' ' || text == "-" || text == "null") return false;
  if (!is_word(text.front()) && kFirst.find(text.front()) == std::string_view::npos) return false;
  if (text.starts_with("- ") || text.starts_with("---") || text.starts_with("...")) return false;
  return std::ranges::all_of(text, may_stand);
}

/// The text in double quotation marks (YAML 1.2, 5.7).
std::string in_quotes(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (byte < 0x20 || byte == 0x7f) {
      quoted += fmt::format("\\x{:02x}", byte);
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string scalar_yaml(std::string_view text, bool quoted) {
  return quoted || !is_plain(text) ? in_quotes(text) : std::string(text);
}

std::string list_yaml(const Node& list) {
  std::string text;
  for (const Node& item : list.items) text += (text.empty() ? "" : ", ") + flow_yaml(item);
  return "[" + text + "]";
}

std::string mapping_yaml(const Node& mapping) {
  std::string text;
  for (const Entry& entry : mapping.entries) {
    text +=
        (text.empty() ? "" : ", ") + scalar_yaml(entry.key, false) + ": " + flow_yaml(entry.value);
  }
  return "{" + text + "}";
}

}  // namespace

std::string flow_yaml(const Node& node) {
  switch (node.kind) {
    case Node::Kind::kScalar:
      return scalar_yaml(node.text, node.quoted);
    case Node::Kind::kList:
      return list_yaml(node);
    case Node::Kind::kMapping:
      return mapping_yaml(node);
    case Node::Kind::kNull:
      break;
  }
  return "~";
}

}  // namespace hal::files::config
