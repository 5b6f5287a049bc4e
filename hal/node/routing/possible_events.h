#pragma once

#include <set>

#include "hal/node/routing/protocol_event.h"
#include "hal/node/routing/routing_config.h"

namespace hal::node::routing {

/// What a router can do with an algorithm: a count of one of these that nobody made is 0, a count
/// of another does not exist.
/// @param tells_of_frames  the link tells what became of each frame; else nodes say hello.
std::set<ProtocolEvent> possible_events(Algorithm algorithm, bool tells_of_frames);

}  // namespace hal::node::routing
