#include "hal/routing/protocol_event.h"

#include "hal/types/check.h"

namespace hal::routing {

std::string_view name(ProtocolEvent event) {
  switch (event) {
    case ProtocolEvent::kNeighbourLost:
      return "neighbour lost";
    case ProtocolEvent::kHelloSent:
      return "hello sent";
    case ProtocolEvent::kForwardAntSent:
      return "forward ant sent";
    case ProtocolEvent::kForwardAntRelayed:
      return "forward ant relayed";
    case ProtocolEvent::kForwardAntAnswered:
      return "forward ant answered";
    case ProtocolEvent::kBackwardAntRelayed:
      return "backward ant relayed";
    case ProtocolEvent::kBackwardAntHome:
      return "backward ant home";
    case ProtocolEvent::kFloodRelayed:
      return "flood relayed";
    case ProtocolEvent::kFloodCopyDropped:
      return "flood copy dropped";
    case ProtocolEvent::kProactiveAntSent:
      return "proactive ant sent";
    case ProtocolEvent::kRepairAntSent:
      return "repair ant sent";
    case ProtocolEvent::kForwardAntPassedOn:
      return "forward ant passed on";
    case ProtocolEvent::kForwardAntDropped:
      return "forward ant dropped";
    case ProtocolEvent::kPheromoneBootstrapped:
      return "pheromone bootstrapped";
    case ProtocolEvent::kLossNoticeSent:
      return "loss notice sent";
    case ProtocolEvent::kLossNoticeReceived:
      return "loss notice received";
    case ProtocolEvent::kWarningSent:
      return "warning sent";
    case ProtocolEvent::kWarningReceived:
      return "warning received";
    case ProtocolEvent::kRepairSucceeded:
      return "repair succeeded";
    case ProtocolEvent::kRepairFailed:
      return "repair failed";
    case ProtocolEvent::kMessageSalvaged:
      return "message salvaged";
    case ProtocolEvent::kCount:
      break;
  }
  BARAKA_CHECK(false);
}

}  // namespace hal::routing
