#include "hal/node/routing/ants.h"

#include <algorithm>
#include <utility>

namespace hal::node::routing {

bool Ants::on_forward_ant(ForwardAnt ant, const Arrival& arrival) {
  if (ant.path.back() != arrival.reception.from) return false;
  const bool was_here = std::find(ant.path.begin(), ant.path.end(), node_.self) != ant.path.end();
  if (was_here) return true;
  Visit* visit = accept(ant);
  if (visit == nullptr) return true;
  const AgentId from = arrival.reception.from;
  ant.way = node_.lengthened(ant.way, arrival.reception, arrival.size);
  visit->back[from] = ant.way;
  const Header header = ant.header;
  if (header.destination != node_.self) {
    relay(std::move(ant));
    return true;
  }
  table_.install({header.topic, header.source, from, ant.way});
  answer(ant);
  forwarding_.on_route(header.topic, header.source);
  return true;
}

/// Accepts the first copy of an ant, and a later one if h <= a h_best and T <= a T_best, with
/// a = `acceptance` (routing_config.h): so several routes are found, but no bad ones.
Ants::Visit* Ants::accept(const ForwardAnt& ant) {
  const int hops = static_cast<int>(ant.path.size());
  // Clocks that disagree must not reverse the comparison of times.
  const Duration took = std::max(Duration::zero(), node_.now() - ant.started);
  auto [visit, is_first] = visits_.note({ant.header.source, ant.header.sequence}, node_.now());
  if (is_first) {
    visit.best_hops = hops;
    visit.best_time = took;
    return &visit;
  }
  if (ant.header.destination != node_.self && !node_.config.accept_anywhere) return nullptr;
  const double band = node_.config.acceptance;
  if (hops > band * visit.best_hops) return nullptr;
  if (to_seconds(took) > band * to_seconds(visit.best_time)) return nullptr;
  visit.best_hops = std::min(visit.best_hops, hops);
  visit.best_time = std::min(visit.best_time, took);
  return &visit;
}

void Ants::answer(const ForwardAnt& ant) {
  const Header& asked = ant.header;
  const BackwardAnt reply{.header = {asked.topic, node_.self, asked.source, asked.sequence},
                          .path = ant.path,
                          .position = static_cast<std::uint8_t>(ant.path.size() - 1),
                          .way = {}};
  node_.count(ProtocolEvent::kForwardAntAnswered);
  outbox_.send_control(ant.path.back(), reply);
}

void Ants::relay(ForwardAnt ant) {
  if (static_cast<int>(ant.path.size()) >= node_.config.hop_limit) return;
  ant.path.push_back(node_.self);
  node_.after_jitter([this, ant = std::move(ant)] {
    node_.count(ProtocolEvent::kForwardAntRelayed);
    outbox_.send_control(kEveryone, ant);
  });
}

bool Ants::on_backward_ant(BackwardAnt ant, const Arrival& arrival) {
  if (ant.path[ant.position] != node_.self) return false;
  const bool is_first_hop = ant.position + 1u == ant.path.size();
  const AgentId expected = is_first_hop ? ant.header.source : ant.path[ant.position + 1u];
  if (expected != arrival.reception.from) return false;

  ant.way = node_.lengthened(ant.way, arrival.reception, arrival.size);
  const Header header = ant.header;
  table_.install({header.topic, header.source, expected, ant.way});
  if (ant.position == 0) {
    node_.count(ProtocolEvent::kBackwardAntHome);
    forwarding_.discovery().on_answer(header.topic, header.source, header.sequence);
  } else {
    teach_way_back(ant);
    walk_on(std::move(ant));
  }
  forwarding_.on_route(header.topic, header.source);
  forwarding_.on_route(header.topic, header.destination);
  return true;
}

void Ants::teach_way_back(const BackwardAnt& ant) {
  const AgentId before = ant.path[ant.position - 1u];
  const Visit* visit = visits_.find({ant.header.destination, ant.header.sequence});
  if (visit == nullptr) return;  // the forward ant is forgotten by now
  const auto back = visit->back.find(before);
  if (back == visit->back.end()) return;
  table_.install({ant.header.topic, ant.header.destination, before, back->second});
}

void Ants::walk_on(BackwardAnt ant) {
  --ant.position;
  node_.count(ProtocolEvent::kBackwardAntRelayed);
  outbox_.send_control(ant.path[ant.position], ant);
}

}  // namespace hal::node::routing
