#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sim::scenario {

/// Quantities that are summed up, or kept, for each agent from the events of a run. Add a new one
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
  /// true: it has no value until the first event, and each event is a sample. false: it counts from
  /// 0.
  bool is_of_events = false;
};

/// All kinds, in the order of the enumeration.
const std::array<TallyKind, kTallies>& tally_kinds();

}  // namespace sim::scenario
