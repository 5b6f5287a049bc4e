#include "hal/node/routing/forwarding.h"

#include <utility>

#include "hal/node/routing/message_end.h"
#include "hal/node/routing/next_hop.h"

namespace hal::node::routing {

Forwarding::Forwarding(Node& node, RouteTable& table, Outbox& outbox)
    : node_(node),
      table_(table),
      outbox_(outbox),
      discovery_(node, outbox, [&node](const Transit& transit, Verdict verdict) {
        end_message(node, transit, verdict);
      }) {}

void Forwarding::send(const Message& message) {
  forward(to_transit(node_, message), Verdict::kExpired);
}

void Forwarding::on_data(Data data, AgentId from) {
  const Header& header = data.header;
  if (header.destination == node_.self) {
    const bool is_new = delivered_.note({header.source, header.sequence}, node_.now()).second;
    if (is_new) deliver(node_, std::move(data));
    return;
  }
  const auto key = std::make_tuple(header.source, header.sequence, data.transmissions);
  if (!relayed_.note(key, node_.now()).second) return;
  forward({.data = std::move(data), .came_from = from, .owes_fate = false}, Verdict::kExpired);
}

void Forwarding::forward(Transit transit, Verdict verdict_if_exhausted) {
  const Header& header = transit.data.header;
  if (transit.data.transmissions >= node_.config.hop_limit) {
    end_message(node_, transit, verdict_if_exhausted);
    return;
  }
  const auto routes = table_.routes(header.topic, header.destination);
  const RouteChoice& choice = node_.config.choice_of(header.topic);
  const auto next_hop = pick_next_hop(routes, transit.came_from, choice, node_.random);
  if (next_hop) {
    outbox_.send_message(*next_hop, std::move(transit));
  } else {
    discovery_.wait(std::move(transit));
  }
}

void Forwarding::on_sent(Transit transit, Verdict verdict) {
  switch (verdict) {
    case Verdict::kDelivered:
      hand_over(node_, transit);
      break;
    case Verdict::kRetryLimit:  // salvage: the routes via that neighbour are removed by now
      forward(std::move(transit), Verdict::kRetryLimit);
      break;
    default:
      end_message(node_, transit, verdict);
  }
}

void Forwarding::on_route(const std::string& topic, AgentId destination) {
  for (Transit& transit : discovery_.release(topic, destination)) {
    forward(std::move(transit), Verdict::kExpired);
  }
}

}  // namespace hal::node::routing
