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
  kFramesBackground,  ///< The first of four, in the order of access categories.
  kFramesBestEffort,
  kFramesVideo,
  kFramesVoice,
  kBlockAcks,
  kBlockAckRequests,
  kFramesReceived,
  kFramesLost,
  kRequestsFailed,
  kRssi,
  kMessagesSent,
  kMessagesArrived,
  kMessagesReceived,
  kDelay,
  kDelayBackground,  ///< The first of four, likewise.
  kDelayBestEffort,
  kDelayVideo,
  kDelayVoice,
  kDiscoveries,
  kDiscoveriesFailed,
  kDiscoveryTime,
  kRouteChanges,
  kCount,
};
inline constexpr std::size_t kTallies = static_cast<std::size_t>(Tally::kCount);

/// The one for an access category. @param first  of the four.
constexpr Tally of_category(Tally first, std::size_t category) {
  return static_cast<Tally>(static_cast<std::size_t>(first) + category);
}

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
