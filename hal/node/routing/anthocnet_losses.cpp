#include "hal/node/routing/anthocnet_losses.h"

#include <algorithm>
#include <utility>

namespace hal::node::routing::anthocnet {

void Losses::on_link_lost(AgentId neighbour) {
  for (const Loss& loss : ants_.table.remove_via(neighbour)) note(loss);
}

void Losses::note(const Loss& loss) {
  last_.note(loss.target, ants_.node.now()).first = loss.path;
  if (loss.was_best) tell(loss.target);
}

/// Schedules a notice after a jitter: it then includes what else breaks or is repaired meanwhile,
/// and neighbours that received the same notice do not answer it simultaneously.
void Losses::tell(const Target& target) {
  untold_.insert(target);
  if (std::exchange(is_waiting_, true)) return;
  Node& node = ants_.node;
  const double most = static_cast<double>(node.config.jitter_max.count());
  const Duration wait{static_cast<std::int64_t>(node.random.uniform() * most)};
  node.timers.schedule(node.now() + wait, [this] { send(); });
}

void Losses::release(const Target& target) {
  held_.erase(target);
  if (untold_.contains(target)) tell(target);
}

void Losses::send() {
  is_waiting_ = false;
  std::vector<LostPath> lost;
  for (const Target& target : untold_) {
    if (!held_.contains(target)) lost.push_back(what_is_left(target));
  }
  std::erase_if(untold_, [this](const Target& target) { return !held_.contains(target); });
  for (std::size_t at = 0; at < lost.size(); at += kMostTargets) {
    send(std::span(lost).subspan(at, std::min(kMostTargets, lost.size() - at)));
  }
}

void Losses::send(std::span<const LostPath> lost) {
  ants_.node.count(ProtocolEvent::kLossNoticeSent);
  ants_.send(kEveryone, LossNotice{{lost.begin(), lost.end()}});
}

LostPath Losses::what_is_left(const Target& target) const {
  const Trail* const best = ants_.table.best_regular(target);
  if (best == nullptr) return {.target = target, .hops = 0, .next_hop = {}, .delay = {}};
  return {.target = target,
          .hops = static_cast<std::uint8_t>(std::min<int>(best->path.hops, 255)),
          .next_hop = best->next_hop,
          .delay = best->path.delay};
}

void Losses::on_notice(const LossNotice& notice, const Arrival& arrival) {
  const AgentId self = ants_.node.self;
  const AgentId from = arrival.reception.from;
  ants_.node.count(ProtocolEvent::kLossNoticeReceived);
  for (const LostPath& lost : notice.lost) {
    if (lost.target.destination == self || lost.target.destination == from) continue;
    const bool is_gone =
        lost.hops == 0 || lost.next_hop == self || lost.hops + 1 > ants_.node.config.hop_limit;
    if (!is_gone) {
      take_worse(lost, arrival);
    } else if (const auto loss = ants_.table.remove(lost.target, from)) {
      note(*loss);
    }
  }
}

/// Replaces the trail via the neighbour by its new best path, extended by one hop.
void Losses::take_worse(const LostPath& lost, const Arrival& arrival) {
  const AgentId from = arrival.reception.from;
  const Trail* const old_best = ants_.table.best_regular(lost.target);
  for (const Trail& trail : ants_.table.trails(lost.target)) {
    if (trail.next_hop != from || trail.regular == 0) continue;
    PathStatistics path = trail.path;
    path.hops = static_cast<std::uint16_t>(lost.hops + 1);
    path.delay = lost.delay + ants_.node.ports.link.expected_delay();
    const double pheromone = ants_.pheromone_of(path);
    ants_.table.lay({lost.target.topic, lost.target.destination, from, path}, pheromone, 0);
    const bool was_best = old_best->next_hop == from;
    if (was_best && pheromone < trail.regular) tell(lost.target);
  }
}

void Losses::on_warning(const Warning& warning, AgentId from) {
  ants_.node.count(ProtocolEvent::kWarningReceived);
  if (warning.target.destination == from) return;
  if (const auto loss = ants_.table.remove(warning.target, from)) note(*loss);
}

void Losses::warn(AgentId neighbour, const Target& target) {
  ants_.node.count(ProtocolEvent::kWarningSent);
  ants_.send(neighbour, Warning{target});
}

}  // namespace hal::node::routing::anthocnet
