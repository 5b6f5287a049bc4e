#include "hal/node/routing/protocol_event.h"

#include <array>

namespace hal::node::routing {
namespace {

struct EventName {
  ProtocolEvent event;
  std::string_view name;
};

/// In the order of the enumeration. A table, because a switch would exceed the length limit of a
/// function.
constexpr std::array<EventName, kProtocolEvents> kEventNames{{
    {ProtocolEvent::kNeighbourLost, "neighbour lost"},
    {ProtocolEvent::kHelloSent, "hello sent"},
    {ProtocolEvent::kForwardAntSent, "forward ant sent"},
    {ProtocolEvent::kForwardAntRelayed, "forward ant relayed"},
    {ProtocolEvent::kForwardAntAnswered, "forward ant answered"},
    {ProtocolEvent::kBackwardAntRelayed, "backward ant relayed"},
    {ProtocolEvent::kBackwardAntHome, "backward ant home"},
    {ProtocolEvent::kFloodRelayed, "flood relayed"},
    {ProtocolEvent::kFloodCopyDropped, "flood copy dropped"},
    {ProtocolEvent::kRreqSent, "rreq sent"},
    {ProtocolEvent::kRreqForwarded, "rreq forwarded"},
    {ProtocolEvent::kRreqDelayed, "rreq delayed"},
    {ProtocolEvent::kRrepSent, "rrep sent"},
    {ProtocolEvent::kRrepSentForOther, "rrep sent for another"},
    {ProtocolEvent::kRrepGratuitous, "gratuitous rrep sent"},
    {ProtocolEvent::kRrepForwarded, "rrep forwarded"},
    {ProtocolEvent::kRrepReceived, "rrep received"},
    {ProtocolEvent::kRrepLost, "rrep lost"},
    {ProtocolEvent::kRreqBlacklisted, "rreq from blacklisted"},
    {ProtocolEvent::kRerrSent, "rerr sent"},
    {ProtocolEvent::kRerrReceived, "rerr received"},
    {ProtocolEvent::kRerrSuppressed, "rerr suppressed"},
    {ProtocolEvent::kLocalRepairStarted, "local repair started"},
    {ProtocolEvent::kLocalRepairDone, "local repair done"},
    {ProtocolEvent::kLocalRepairFailed, "local repair failed"},
    {ProtocolEvent::kProactiveAntSent, "proactive ant sent"},
    {ProtocolEvent::kRepairAntSent, "repair ant sent"},
    {ProtocolEvent::kForwardAntPassedOn, "forward ant passed on"},
    {ProtocolEvent::kForwardAntDropped, "forward ant dropped"},
    {ProtocolEvent::kPheromoneBootstrapped, "pheromone bootstrapped"},
    {ProtocolEvent::kLossNoticeSent, "loss notice sent"},
    {ProtocolEvent::kLossNoticeReceived, "loss notice received"},
    {ProtocolEvent::kWarningSent, "warning sent"},
    {ProtocolEvent::kWarningReceived, "warning received"},
    {ProtocolEvent::kRepairSucceeded, "repair succeeded"},
    {ProtocolEvent::kRepairFailed, "repair failed"},
    {ProtocolEvent::kMessageSalvaged, "message salvaged"},
}};

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < kProtocolEvents; ++i) {
    const EventName& one = kEventNames[i];
    if (one.event != static_cast<ProtocolEvent>(i) || one.name.empty()) return false;
  }
  return true;
}
static_assert(is_in_order());

}  // namespace

std::string_view name(ProtocolEvent event) {
  return kEventNames.at(static_cast<std::size_t>(event)).name;
}

}  // namespace hal::node::routing
