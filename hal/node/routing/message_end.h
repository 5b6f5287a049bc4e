#pragma once

#include "hal/node/routing/outbox.h"

namespace hal::node::routing {

/// The fate that the sender of a message gets for a verdict other than kDelivered.
Fate fate_of(Verdict verdict);

/// Ends of a message at a node. Its sender is notified in a separate event at the same time, and
/// therefore never from within its own call.

/// The next hop acknowledged the message, or it was transmitted as a broadcast.
void hand_over(Node& node, const Transit& transit);

/// The message is not forwarded any further.
void end_message(Node& node, const Transit& transit, Verdict verdict);

/// The message has arrived at this node. Calls the application, so call it last.
void deliver(Node& node, Data data);

/// Converts a message of the application and gives it a sequence number.
Transit to_transit(Node& node, const Message& message);

}  // namespace hal::node::routing
