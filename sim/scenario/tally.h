#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sim::scenario {

/// What is added up, or remembered, of each agent from what happens in a run. A new one goes in
/// before kCount, with its row in tally.cpp.
enum class Tally : std::uint8_t {
  kFramesSent,
  kRetries,
  kAirtime,
  kFramesReceived,
  kFramesLost,
  kRequestsFailed,
  kRssi,
  kMessagesSent,
  kMessagesArrived,
  kMessagesReceived,
  kDelay,
  kDiscoveries,
  kDiscoveriesFailed,
  kDiscoveryTime,
  kRouteChanges,
  kCount,
};
inline constexpr std::size_t kTallies = static_cast<std::size_t>(Tally::kCount);

struct TallyKind {
  Tally tally;
  std::string_view domain, name, unit, meaning;
  /// It has no value until something happens, and each time is one to look at; else it counts from
  /// 0.
  bool is_of_events = false;
};

/// In the order of the enumeration.
const std::array<TallyKind, kTallies>& tally_kinds();

}  // namespace sim::scenario
