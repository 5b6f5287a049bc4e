#include "hal/node/routing/outbox.h"

#include <utility>

#include "hal/types/check.h"

namespace hal::node::routing {

void Outbox::send_message(AgentId next_hop, Transit transit) {
  BARAKA_CHECK(transit.data.transmissions < 255);
  ++transit.data.transmissions;
  const Packet packet = transit.data;
  transmit(next_hop, packet, {.next_hop = next_hop, .transit = std::move(transit), .done = {}});
}

void Outbox::transmit(AgentId next_hop, const Packet& packet, Outgoing outgoing) {
  const LinkTag tag = ++last_tag_;
  const Priority priority =
      outgoing.transit ? outgoing.transit->data.priority : node_.config.control_priority;
  outgoing_.emplace(tag, std::move(outgoing));
  node_.ports.link.transmit(next_hop, encode(packet), {tag, priority});
}

void Outbox::on_transmitted(const Transmission& transmission) {
  auto entry = outgoing_.extract(transmission.tag);
  if (entry.empty()) return;
  Outgoing& outgoing = entry.mapped();
  if (transmission.verdict == Verdict::kRetryLimit) listener_.on_no_answer(outgoing.next_hop);
  if (outgoing.transit) {
    listener_.on_sent(std::move(*outgoing.transit), transmission.verdict);
  } else if (outgoing.done) {
    outgoing.done(transmission.verdict);
  }
}

}  // namespace hal::node::routing
