#pragma once

#include "hal/routing/outbox.h"

namespace hal::routing {

/// What its sender is told of a message that ended with this, other than kDelivered.
Fate fate_of(Verdict verdict);

/// How a message leaves a node's care. Its sender is told in an event of its own at the same time,
/// so never from within its own call.

/// The next hop has it, or it left the antenna.
void hand_over(Node& node, const Transit& transit);

/// It goes no further.
void end_message(Node& node, const Transit& transit, Verdict verdict);

/// It has arrived at this node. Calls the application: do it last.
void deliver(Node& node, Data data);

/// A message as the application gave it, with a number for the network.
Transit to_transit(Node& node, const Message& message);

}  // namespace hal::routing
