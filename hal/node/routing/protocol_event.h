#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace hal::node::routing {

/// Events of routing protocols that are counted. Add new ones before kCount, with a name in
/// protocol_event.cpp.
enum class ProtocolEvent : std::uint8_t {
  kNeighbourLost,  ///< It did not answer, or was silent for too long.
  kHelloSent,
  // Ants.
  kForwardAntSent,      ///< A search for a route, each try.
  kForwardAntRelayed,   ///< Broadcast on.
  kForwardAntAnswered,  ///< At its destination: a backward ant sets out.
  kBackwardAntRelayed,
  kBackwardAntHome,  ///< It came to the node that searched.
  // Floods of messages.
  kFloodRelayed,
  kFloodCopyDropped,  ///< A message that this node had already.
  // AODV (RFC 3561).
  kRreqSent,          ///< By the node that searches, each try.
  kRreqForwarded,     ///< Broadcast on.
  kRreqDelayed,       ///< RREQ_RATELIMIT.
  kRrepSent,          ///< By the destination.
  kRrepSentForOther,  ///< By a node on the way that has a route.
  kRrepGratuitous,
  kRrepForwarded,
  kRrepReceived,     ///< By the node that searched.
  kRrepLost,         ///< The next hop towards that one did not answer, and is blacklisted.
  kRreqBlacklisted,  ///< Ignored: came over a link that carries one way only.
  kRerrSent,
  kRerrReceived,
  kRerrSuppressed,  ///< RERR_RATELIMIT.
  kLocalRepairStarted,
  kLocalRepairDone,
  kLocalRepairFailed,
  // AntHocNet, beside those of ants. What it broadcasts on counts as relayed.
  kProactiveAntSent,
  kRepairAntSent,
  kForwardAntPassedOn,  ///< Unicast, where pheromone leads.
  kForwardAntDropped,   ///< A copy that is not good enough, or an ant whose broadcasts are used up.
  kPheromoneBootstrapped,  ///< From one target of a neighbour's hello.
  kLossNoticeSent,
  kLossNoticeReceived,
  kWarningSent,  ///< A message came for which there is no trail.
  kWarningReceived,
  kRepairSucceeded,
  kRepairFailed,
  kMessageSalvaged,  ///< The next hop did not answer, and the message is not given up yet.
  kCount,
};
inline constexpr std::size_t kProtocolEvents = static_cast<std::size_t>(ProtocolEvent::kCount);

/// "forward ant sent", …
std::string_view name(ProtocolEvent event);

}  // namespace hal::node::routing
