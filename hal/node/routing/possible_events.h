#pragma once

#include <set>

#include "hal/node/routing/protocol_event.h"
#include "hal/node/routing/routing_config.h"

namespace hal::node::routing {

/// Events that a router can count with an algorithm: those that did not occur have the count 0; for
/// all others there is no count.
/// @param tells_of_frames  the link reports the result of each frame; otherwise nodes send hellos.
std::set<ProtocolEvent> possible_events(Algorithm algorithm, bool tells_of_frames);

}  // namespace hal::node::routing
