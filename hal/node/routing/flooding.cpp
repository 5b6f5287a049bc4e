#include "hal/node/routing/flooding.h"

#include <utility>

#include "hal/node/routing/message_end.h"

namespace hal::node::routing {

void Flooding::send(const Message& message) {
  // At the link a flood is always a broadcast to kEveryone.
  outbox_.send_message(kEveryone, to_transit(node_, message));
}

void Flooding::on_data(Data data) {
  const Header& header = data.header;
  if (header.source == node_.self) return;  // our own flood, relayed by a neighbour
  if (!seen_.note({header.source, header.sequence}, node_.now()).second) {
    node_.count(ProtocolEvent::kFloodCopyDropped);
    return;
  }
  relay(data);
  if (header.destination == node_.self || is_broadcast(header.destination)) {
    deliver(node_, std::move(data));
  }
}

void Flooding::relay(const Data& data) {
  const AgentId destination = data.header.destination;
  if (destination == kNeighbours || destination == node_.self) return;
  if (data.transmissions >= node_.config.hop_limit) return;
  node_.after_jitter([this, data] {
    node_.count(ProtocolEvent::kFloodRelayed);
    outbox_.send_message(kEveryone, {.data = data, .came_from = std::nullopt, .owes_fate = false});
  });
}

void Flooding::on_sent(const Transit& transit, Verdict verdict) {
  if (verdict == Verdict::kDelivered) {
    hand_over(node_, transit);
  } else if (transit.owes_fate) {
    // The message as a whole ends with this only at its source; elsewhere other relays have copies.
    end_message(node_, transit, verdict);
  }
}

}  // namespace hal::node::routing
