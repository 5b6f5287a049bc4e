#include "hal/node/routing/anthocnet_ants.h"

#include <algorithm>
#include <utility>

namespace hal::node::routing::anthocnet {
namespace {

Target target_of(const ForwardAnt& ant) { return {ant.header.topic, ant.header.destination}; }
Target target_of(const BackwardAnt& ant) { return {ant.header.topic, ant.header.source}; }

ProtocolEvent launch_of(AntKind kind) {
  switch (kind) {
    case AntKind::kProactive:
      return ProtocolEvent::kProactiveAntSent;
    case AntKind::kRepair:
      return ProtocolEvent::kRepairAntSent;
    default:
      return ProtocolEvent::kForwardAntSent;
  }
}

/// First hop of a copy of an ant received at `self`: the node after its source.
AgentId first_hop_of(const ForwardAnt& ant, AgentId self) {
  return ant.path.size() > 1 ? ant.path[1] : self;
}

}  // namespace

Sequence Ants::launch(const Target& target, AntKind kind) {
  Node& node = ants_.node;
  const Sequence sequence = node.next_sequence();
  node.count(launch_of(kind));
  Visit& visit = visits_.note({node.self, sequence}, node.now()).first;
  pass_on({.header = {target.topic, node.self, target.destination, sequence},
           .kind = kind,
           .broadcasts = 0,
           .way = {},
           .path = {}},
          visit);
  return sequence;
}

bool Ants::on_forward_ant(ForwardAnt ant, const Arrival& arrival) {
  if (ant.path.back() != arrival.reception.from) return false;
  const AgentId self = ants_.node.self;
  if (std::ranges::find(ant.path, self) != ant.path.end()) return true;
  ant.way = ants_.node.lengthened(ant.way, arrival.reception, arrival.size);
  Visit* visit = accept(ant);
  if (visit == nullptr) {
    ants_.node.count(ProtocolEvent::kForwardAntDropped);
  } else if (ant.header.destination == self) {
    answer(ant);
  } else {
    pass_on(std::move(ant), *visit);
  }
  return true;
}

/// Accepts the first copy of an ant, and later ones by (A7). The factor is `acceptance`, or
/// acceptance_new_first_hop if no accepted copy had its first hop ([ETT], 3.2). The time is the
/// estimate that the ant carries, not a difference of two clocks.
Ants::Visit* Ants::accept(const ForwardAnt& ant) {
  const int hops = ant.way.hops;
  const Duration time = ant.way.delay;
  const AgentId first_hop = first_hop_of(ant, ants_.node.self);
  auto [visit, is_first] = visits_.note({ant.header.source, ant.header.sequence}, ants_.node.now());
  if (is_first) {
    visit.best_hops = hops;
    visit.best_time = time;
  } else {
    const bool is_new_way = !visit.first_hops.contains(first_hop);
    const AntHocNetConfig& config = ants_.config();
    const double band = is_new_way ? config.acceptance_new_first_hop : config.acceptance;
    if (hops > band * visit.best_hops) return nullptr;
    if (to_seconds(time) > band * to_seconds(visit.best_time)) return nullptr;
    visit.best_hops = std::min(visit.best_hops, hops);
    visit.best_time = std::min(visit.best_time, time);
  }
  visit.first_hops.insert(first_hop);
  return &visit;
}

void Ants::answer(const ForwardAnt& ant) {
  const Header& asked = ant.header;
  ants_.node.count(ProtocolEvent::kForwardAntAnswered);
  ants_.send(ant.path.back(),
             BackwardAnt{.header = {asked.topic, ants_.node.self, asked.source, asked.sequence},
                         .kind = ant.kind,
                         .position = static_cast<std::uint8_t>(ant.path.size() - 1),
                         .way = {},
                         .path = ant.path});
}

std::optional<AgentId> Ants::next_hop_of(const ForwardAnt& ant) {
  Node& node = ants_.node;
  const AntHocNetConfig& config = ants_.config();
  const Target target = target_of(ant);
  diffusion_.know(target);
  const bool is_proactive = ant.kind == AntKind::kProactive;
  if (is_proactive && config.proactive_broadcast_probability > 0 &&
      node.random.uniform() < config.proactive_broadcast_probability) {
    return std::nullopt;
  }
  const Weight weight = is_proactive ? any_weight : regular_weight;
  const double beta = is_proactive ? config.beta_proactive : config.beta_reactive;
  return pick(ants_.table.trails(target), weight, beta, ant.path, node.random);
}

bool Ants::may_broadcast(const ForwardAnt& ant, const Visit& visit) const {
  const AntHocNetConfig& config = ants_.config();
  if (visit.broadcasts >= config.copies) return false;
  switch (ant.kind) {
    case AntKind::kProactive:
      return ant.broadcasts < config.proactive_broadcasts;
    case AntKind::kRepair:
      return ant.broadcasts < config.repair_broadcasts;
    default:
      return ant.broadcasts < 255;
  }
}

void Ants::pass_on(ForwardAnt ant, Visit& visit) {
  Node& node = ants_.node;
  const bool is_launch = ant.path.empty();
  const bool is_too_long = static_cast<int>(ant.path.size()) >= node.config.hop_limit;
  ant.path.push_back(node.self);
  const auto next_hop = is_too_long ? std::nullopt : next_hop_of(ant);
  if (next_hop) {
    if (!is_launch) node.count(ProtocolEvent::kForwardAntPassedOn);
    return ants_.send(*next_hop, ant);
  }
  if (is_too_long || !may_broadcast(ant, visit)) {
    node.count(ProtocolEvent::kForwardAntDropped);
    return;
  }
  ++visit.broadcasts;
  ++ant.broadcasts;
  if (is_launch) return ants_.send(kEveryone, ant);
  node.count(ProtocolEvent::kForwardAntRelayed);
  node.after_jitter([ants = ants_, ant = std::move(ant)] { ants.send(kEveryone, ant); });
}

bool Ants::on_backward_ant(BackwardAnt ant, const Arrival& arrival) {
  Node& node = ants_.node;
  if (ant.path[ant.position] != node.self) return false;
  const bool is_first_hop = ant.position + 1u == ant.path.size();
  const AgentId from = is_first_hop ? ant.header.source : ant.path[ant.position + 1u];
  if (from != arrival.reception.from) return false;

  ant.way = node.lengthened(ant.way, arrival.reception, arrival.size);
  const Target target = target_of(ant);
  ants_.table.lay({target.topic, target.destination, from, ant.way}, ants_.pheromone_of(ant.way),
                  ants_.config().pheromone_weight);
  if (ant.position == 0) {
    node.count(ProtocolEvent::kBackwardAntHome);
    listener_.on_home(target, ant.kind, ant.header.sequence);
  } else {
    node.count(ProtocolEvent::kBackwardAntRelayed);
    --ant.position;
    ants_.send(ant.path[ant.position], ant);
  }
  listener_.on_trail(target);
  return true;
}

}  // namespace hal::node::routing::anthocnet
