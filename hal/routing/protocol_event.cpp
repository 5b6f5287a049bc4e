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
    case ProtocolEvent::kCount:
      break;
  }
  BARAKA_CHECK(false);
}

}  // namespace hal::routing
