#include "gateway/runtime/mistakes.h"

#include <fmt/format.h>

#include <cctype>

namespace gateway::runtime {
namespace {

/// Limits the log of a controller that always makes new kinds of mistakes.
constexpr std::size_t kMostKinds = 32;

/// The text without numbers and quoted parts.
std::string kind_in(std::string_view text) {
  std::string kind;
  bool quoted = false;
  for (const char c : text) {
    if (c == '\'') quoted = !quoted;
    const bool is_number = std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-';
    if (!quoted && !is_number) kind += c;
  }
  return kind;
}

bool is_power_of_ten(std::uint64_t count) {
  while (count >= 10 && count % 10 == 0) count /= 10;
  return count == 1;
}

}  // namespace

Mistakes::Kind& Mistakes::kind_of(const std::string& text) {
  std::string kind = kind_in(text);
  if (kinds_.size() >= kMostKinds && !numbers_.contains(kind)) kind.clear();
  const auto [number, is_new] = numbers_.try_emplace(kind, kinds_.size());
  if (is_new) kinds_.push_back({.first = text});
  return kinds_[number->second];
}

std::optional<std::string> Mistakes::add(const std::string& text) {
  Kind& kind = kind_of(text);
  if (!is_power_of_ten(++kind.count)) return std::nullopt;
  kind.told = kind.count;
  return kind.count == 1 ? text : fmt::format("{} ({} times by now)", text, kind.count);
}

std::vector<std::string> Mistakes::rest() const {
  std::vector<std::string> lines;
  for (const Kind& kind : kinds_) {
    if (kind.count == kind.told) continue;
    lines.push_back(fmt::format("{}: {} times in all", kind.first, kind.count));
  }
  return lines;
}

}  // namespace gateway::runtime
