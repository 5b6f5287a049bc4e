#pragma once

#include "hal/node/routing/outbox.h"

namespace hal::node::routing {

/// The fate that the sender of a message gets for a verdict other than kDelivered.
Fate fate_of(Verdict verdict);

/// Ends of a message at a node. Its sender is told in a separate event at the same time, and
/// therefore never from within its own call.

/// The next hop acknowledged it, or it was transmitted as a broadcast.
void hand_over(Node& node, const Transit& transit);

/// It is not forwarded any further.
void end_message(Node& node, const Transit& transit, Verdict verdict);

/// It has arrived at this node. Calls the application: do it last.
void deliver(Node& node, Data data);

/// A message as the application gave it, with a number for the network.
Transit to_transit(Node& node, const Message& message);

}  // namespace hal::node::routing
