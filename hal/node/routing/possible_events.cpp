#include "hal/node/routing/possible_events.h"

namespace hal::node::routing {

std::set<ProtocolEvent> possible_events(Algorithm algorithm, bool tells_of_frames) {
  const std::span<const ProtocolEvent> own = algorithm.kind().events;
  std::set<ProtocolEvent> events(own.begin(), own.end());
  events.insert(ProtocolEvent::kNeighbourLost);
  if (!own.empty() && !tells_of_frames) events.insert(ProtocolEvent::kHelloSent);
  return events;
}

}  // namespace hal::node::routing
