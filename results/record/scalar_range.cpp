// What the name of a scalar tells about its range.
#include <algorithm>
#include <array>
#include <string_view>

#include "results/record/scalars.h"

namespace results::record {
namespace {

/// Takes the part of a name before its first dot off.
std::string_view take_part(std::string_view& name) {
  const std::string_view part = name.substr(0, name.find('.'));
  name.remove_prefix(std::min(part.size() + 1, name.size()));
  return part;
}

/// Whether a part of the name of a family is a word in capitals.
bool is_word(std::string_view part) {
  return around_word(part) == std::pair(std::string_view(), std::string_view());
}

/// Whether a name belongs to a family: "topics.audio.sent" to "topics.TOPIC.sent". A word has no
/// dots.
bool is_of(std::string_view name, std::string_view family) {
  if (!around_word(family) || std::ranges::count(name, '.') != std::ranges::count(family, '.'))
    return false;
  while (!family.empty()) {
    const std::string_view own = take_part(name);
    const std::string_view part = take_part(family);
    if (is_word(part) ? own.empty() : own != part) return false;
  }
  return true;
}

/// Observables that are shares; names without agents.
constexpr std::array<std::string_view, 6> kShares = {"agents.battery",       "radio.on",
                                                     "radio.transmit_share", "radio.receive_share",
                                                     "radio.idle_share",     "radio.off_share"};
constexpr std::string_view kDdsPrefix = "dds.", kDeliveredShare = ".delivered_share";
constexpr std::array<std::string_view, 5> kNotNegative = {
    "agents.tilt", "agents.speed", "agents.clearance", "agents.odometry_error", "agents.energy"};

/// In the domains of radios, routing, messages and DDS topics all values are counts, times or
/// shares, except the power of a frame.
Range range_of_observable(std::string_view name) {
  if (std::ranges::find(kShares, name) != kShares.end()) return Range::kShare;
  if (std::ranges::find(kNotNegative, name) != kNotNegative.end()) return Range::kNotNegative;
  if (name.starts_with(kDdsPrefix) && std::ranges::count(name, '.') == 2)
    return name.ends_with(kDeliveredShare) ? Range::kShare : Range::kNotNegative;
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

std::string trials_of(std::string_view name) {
  const ScalarKind* const kind = scalar_kind_of(name);
  if (kind == nullptr) return {};
  std::string trials;
  std::string_view rest = kind->trials;
  while (!rest.empty()) {
    const std::string_view part = take_part(rest);
    const std::string_view own = take_part(name);
    trials.append(trials.empty() ? "" : ".").append(is_word(part) ? own : part);
  }
  return trials;
}

Range range_of(std::string_view name) {
  if (const ScalarKind* kind = scalar_kind_of(name)) return range_of(*kind);
  if (name.ends_with(".count")) return Range::kCount;
  if (name.ends_with(".sd")) return Range::kNotNegative;
  const Range own = range_of_observable(name);
  return own != Range::kAny ? own : range_of_observable(name.substr(0, name.rfind('.')));
}

}  // namespace results::record
