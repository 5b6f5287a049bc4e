#include "hal/node/routing/message_end.h"

#include <utility>

namespace hal::node::routing {
namespace {

void tell_sender(Node& node, const Transit& transit, Fate fate) {
  if (!transit.owes_fate) return;
  node.timers.schedule(node.now(), [&node, id = transit.data.id, fate] {
    node.ports.application.on_fate(id, fate);
  });
}

}  // namespace

Fate fate_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNoRoute:
    case Verdict::kExpired:
      return Fate::kNoRoute;
    case Verdict::kQueueFull:
      return Fate::kQueueFull;
    default:
      return Fate::kFailed;
  }
}

void hand_over(Node& node, const Transit& transit) {
  tell_sender(node, transit, Fate::kHandedOver);
}

void end_message(Node& node, const Transit& transit, Verdict verdict) {
  const Header& header = transit.data.header;
  node.ports.observer.on_message_end(header.source, transit.data.id, header.topic, verdict);
  tell_sender(node, transit, fate_of(verdict));
}

void deliver(Node& node, Data data) {
  const Header& header = data.header;
  node.ports.observer.on_message_end(header.source, data.id, header.topic, Verdict::kDelivered);
  node.ports.application.on_message({.source = header.source,
                                     .destination = header.destination,
                                     .id = data.id,
                                     .topic = header.topic,
                                     .payload = std::move(data.payload),
                                     .priority = data.priority},
                                    data.transmissions);
}

Transit to_transit(Node& node, const Message& message) {
  return {.data = {.header = {message.topic, node.self, message.destination, node.next_sequence()},
                   .id = message.id,
                   .transmissions = 0,
                   .payload = message.payload,
                   .priority = message.priority},
          .came_from = std::nullopt,
          .owes_fate = true};
}

}  // namespace hal::node::routing
