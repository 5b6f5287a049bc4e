// What the name of a scalar tells about its range.
#include <algorithm>
#include <array>
#include <string_view>

#include "results/record/scalars.h"

namespace results::record {
namespace {

/// Whether a name belongs to a family: "topics.audio.sent" to "topics.TOPIC.sent". A word has no
/// dots.
bool is_of(std::string_view name, std::string_view family) {
  const auto around = around_word(family);
  if (!around) return false;
  const auto& [head, tail] = *around;
  if (name.size() <= head.size() + tail.size()) return false;
  if (!name.starts_with(head) || !name.ends_with(tail)) return false;
  const auto word = name.substr(head.size(), name.size() - head.size() - tail.size());
  return word.find('.') == std::string_view::npos;
}

/// Observables that are shares; names without agents.
constexpr std::array<std::string_view, 6> kShares = {"agents.battery",       "radio.on",
                                                     "radio.transmit_share", "radio.receive_share",
                                                     "radio.idle_share",     "radio.off_share"};
constexpr std::array<std::string_view, 5> kNotNegative = {
    "agents.tilt", "agents.speed", "agents.clearance", "agents.odometry_error", "agents.energy"};

/// In the domains of radios, routing and messages all values are counts, times or shares, except
/// the power of a frame.
Range range_of_observable(std::string_view name) {
  if (std::ranges::find(kShares, name) != kShares.end()) return Range::kShare;
  if (std::ranges::find(kNotNegative, name) != kNotNegative.end()) return Range::kNotNegative;
  const std::string_view domain = name.substr(0, name.find('.'));
  const bool counts = domain == "radio" || domain == "routing" || domain == "messages";
  const bool is_value = std::ranges::count(name, '.') == 1;
  return counts && is_value && name != "radio.rssi" ? Range::kNotNegative : Range::kAny;
}

Range range_of(const ScalarKind& kind) {
  if (kind.range) return *kind.range;
  if (kind.unit.empty()) return Range::kAny;
  return kind.unit == "1" ? Range::kCount : Range::kNotNegative;
}

}  // namespace

std::optional<std::pair<std::string_view, std::string_view>> around_word(std::string_view family) {
  const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  const auto* const first = std::ranges::find_if(family, is_capital);
  if (first == family.end()) return std::nullopt;
  const auto* const last = std::find_if_not(first, family.end(), is_capital);
  return std::pair(std::string_view(family.begin(), first), std::string_view(last, family.end()));
}

const ScalarKind* scalar_kind_of(std::string_view name) {
  const auto& kinds = scalar_kinds();
  // "frames.sent" has a kind of its own besides "frames.CLASS".
  const auto own = std::ranges::find(kinds, name, &ScalarKind::name);
  if (own != kinds.end()) return &*own;
  const auto found =
      std::ranges::find_if(kinds, [&](const ScalarKind& kind) { return is_of(name, kind.name); });
  return found == kinds.end() ? nullptr : &*found;
}

Range range_of(std::string_view name) {
  if (const ScalarKind* kind = scalar_kind_of(name)) return range_of(*kind);
  if (name.ends_with(".count")) return Range::kCount;
  if (name.ends_with(".sd")) return Range::kNotNegative;
  const Range own = range_of_observable(name);
  return own != Range::kAny ? own : range_of_observable(name.substr(0, name.rfind('.')));
}

}  // namespace results::record
