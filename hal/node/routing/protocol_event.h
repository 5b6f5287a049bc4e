#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace hal::node::routing {

/// Events of routing protocols that are counted. Add new ones before kCount, with a name in
/// protocol_event.cpp.
enum class ProtocolEvent : std::uint8_t {
  kNeighbourLost,  ///< A neighbour did not acknowledge, or was silent for too long.
  kHelloSent,
  // Ants.
  kForwardAntSent,      ///< For a search, each try.
  kForwardAntRelayed,   ///< Broadcast by a relay.
  kForwardAntAnswered,  ///< At its destination, which sends a backward ant.
  kBackwardAntRelayed,
  kBackwardAntHome,  ///< It reached the node that searched.
  // Floods of messages.
  kFloodRelayed,
  kFloodCopyDropped,  ///< A message that this node had received before.
  // AODV (RFC 3561).
  kRreqSent,          ///< By the node that searches, each try.
  kRreqForwarded,     ///< Broadcast by a relay.
  kRreqDelayed,       ///< By RREQ_RATELIMIT.
  kRrepSent,          ///< By the destination.
  kRrepSentForOther,  ///< By a relay that has a route.
  kRrepGratuitous,
  kRrepForwarded,
  kRrepReceived,  ///< By the node that searched.
  /// The next hop towards the originator did not acknowledge, and is blacklisted.
  kRrepLost,
  kRreqBlacklisted,  ///< Ignored: it came over a unidirectional link.
  kRerrSent,
  kRerrReceived,
  kRerrSuppressed,  ///< By RERR_RATELIMIT.
  kLocalRepairStarted,
  kLocalRepairDone,
  kLocalRepairFailed,
  // AntHocNet, in addition to those of ants. A broadcast by a relay counts as relayed.
  kProactiveAntSent,
  kRepairAntSent,
  kForwardAntPassedOn,  ///< Unicast along pheromone.
  /// A copy that is not good enough, or an ant that has used up its broadcasts.
  kForwardAntDropped,
  kPheromoneBootstrapped,  ///< From one target in a neighbour's hello.
  kLossNoticeSent,
  kLossNoticeReceived,
  kWarningSent,  ///< For a received message without a trail.
  kWarningReceived,
  kRepairSucceeded,
  kRepairFailed,
  /// The next hop did not acknowledge, and the message is sent on another trail or waits for one.
  kMessageSalvaged,
  kCount,
};
inline constexpr std::size_t kProtocolEvents = static_cast<std::size_t>(ProtocolEvent::kCount);

/// "forward ant sent", …
std::string_view name(ProtocolEvent event);

}  // namespace hal::node::routing
