#include "hal/node/routing/anthocnet_forwarding.h"

#include <utility>

#include "hal/node/routing/message_end.h"

namespace hal::node::routing::anthocnet {
namespace {

Target target_of(const Transit& transit) {
  return {transit.data.header.topic, transit.data.header.destination};
}

}  // namespace

void DataForwarding::send(const Message& message) {
  parts_.sessions.on_message({message.topic, message.destination});
  forward(to_transit(ants_.node, message), Verdict::kExpired);
}

void DataForwarding::on_data(Data data, AgentId from) {
  Node& node = ants_.node;
  const Header& header = data.header;
  if (header.destination == node.self) {
    const bool is_new = delivered_.note({header.source, header.sequence}, node.now()).second;
    if (is_new) deliver(node, std::move(data));
    return;
  }
  const auto key = std::make_tuple(header.source, header.sequence, data.transmissions);
  if (!relayed_.note(key, node.now()).second) return;
  forward({.data = std::move(data), .came_from = from, .owes_fate = false}, Verdict::kExpired);
}

void DataForwarding::forward(Transit transit, Verdict verdict_if_exhausted) {
  Node& node = ants_.node;
  if (transit.data.transmissions >= node.config.hop_limit) {
    end_message(node, transit, verdict_if_exhausted);
    return;
  }
  const Target target = target_of(transit);
  parts_.diffusion.know(target);
  const std::vector<Trail> trails = ants_.table.trails(target);
  const double beta = ants_.config().beta_data;
  std::optional<AgentId> next_hop;
  if (transit.came_from) {
    next_hop = pick(trails, regular_weight, beta, {*transit.came_from}, node.random);
  }
  if (!next_hop) next_hop = pick(trails, regular_weight, beta, {}, node.random);
  if (next_hop) {
    ants_.outbox.send_message(*next_hop, std::move(transit));
  } else {
    on_no_trail(std::move(transit), verdict_if_exhausted == Verdict::kRetryLimit);
  }
}

void DataForwarding::on_no_trail(Transit transit, bool has_failed) {
  const Target target = target_of(transit);
  if (!transit.came_from) {
    if (parts_.backlog.keep(std::move(transit))) parts_.setup.begin(target);
    return;
  }
  const bool is_looked_for = parts_.setup.is_on(target) || parts_.repair.is_on(target);
  if (is_looked_for || (has_failed && parts_.repair.begin(target))) {
    parts_.backlog.keep(std::move(transit));
    return;
  }
  parts_.losses.warn(*transit.came_from, target);
  end_message(ants_.node, transit, has_failed ? Verdict::kRetryLimit : Verdict::kNoRoute);
}

void DataForwarding::on_sent(Transit transit, Verdict verdict) {
  switch (verdict) {
    case Verdict::kDelivered:
      hand_over(ants_.node, transit);
      break;
    case Verdict::kRetryLimit:  // the trails via that neighbour are removed by now
      ants_.node.count(ProtocolEvent::kMessageSalvaged);
      forward(std::move(transit), Verdict::kRetryLimit);
      break;
    default:
      end_message(ants_.node, transit, verdict);
  }
}

void DataForwarding::on_trail(const Target& target) {
  for (Transit& transit : parts_.backlog.release(target)) {
    forward(std::move(transit), Verdict::kExpired);
  }
}

}  // namespace hal::node::routing::anthocnet
