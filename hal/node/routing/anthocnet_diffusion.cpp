#include "hal/node/routing/anthocnet_diffusion.h"

#include <algorithm>
#include <utility>

namespace hal::node::routing::anthocnet {
namespace {

constexpr double kHelloJitter = 0.25;  // share of a period, at most: RFC 5148, 5.4

Duration share_of(Duration whole, double share) {
  return Duration{static_cast<std::int64_t>(static_cast<double>(whole.count()) * share)};
}

std::optional<Scent> scent_of(const PheromoneTable& table, const Target& target) {
  const Trail* const regular = table.best_regular(target);
  const Trail* const bootstrapped = table.best_virtual(target);
  const double real = regular != nullptr ? regular->regular : 0;
  const bool is_virtual = bootstrapped != nullptr && bootstrapped->bootstrapped > real;
  if (regular == nullptr && !is_virtual) return std::nullopt;
  const Trail& best = is_virtual ? *bootstrapped : *regular;
  const int hops = std::min<int>(best.path.hops, 255);
  return Scent{.target = target,
               .next_hop = best.next_hop,
               .is_virtual = is_virtual,
               .hops = static_cast<std::uint8_t>(is_virtual ? 0 : hops),
               .pheromone = is_virtual ? best.bootstrapped : best.regular};
}

}  // namespace

Diffusion::Diffusion(AntNode ants, bool watches, Link& link,
                     std::function<void(AgentId)> on_silence)
    : ants_(ants), watches_(watches), watch_(ants.node, link, std::move(on_silence)) {}

void Diffusion::start() {
  Node& node = ants_.node;
  const Duration wait = share_of(node.config.hello_period, node.random.uniform());
  node.timers.schedule(node.now() + wait, [this] { send(); });
}

void Diffusion::send() {
  Node& node = ants_.node;
  const Duration period = node.config.hello_period;
  ants_.send(kEveryone, PheromoneHello{period, scents()});
  node.count(ProtocolEvent::kHelloSent);
  const Duration wait = period - share_of(period, kHelloJitter * node.random.uniform());
  node.timers.schedule(node.now() + wait, [this] { send(); });
}

/// Draws as many of the known targets as a hello holds, by a partial Fisher-Yates shuffle.
std::vector<Scent> Diffusion::scents() {
  std::vector<Scent> known;
  for (const Target& target : ants_.table.targets()) {
    know(target);
    if (auto scent = scent_of(ants_.table, target)) known.push_back(std::move(*scent));
  }
  const auto most = static_cast<std::size_t>(ants_.config().hello_destinations);
  if (known.size() <= most) return known;
  for (std::size_t i = 0; i < most; ++i) {
    const auto left = static_cast<std::uint32_t>(known.size() - i);
    std::swap(known[i], known[i + ants_.node.random.below(left)]);
  }
  known.resize(most);
  return known;
}

void Diffusion::on_heard(AgentId from) {
  if (watches_) watch_.on_heard(from);
}

void Diffusion::on_hello(const PheromoneHello& hello, const Arrival& arrival) {
  const AgentId from = arrival.reception.from;
  if (watches_) watch_.on_hello(from, Hello{hello.period});
  neighbours_[from] = ants_.node.lengthened({}, arrival.reception, arrival.size);
  for (const Scent& scent : hello.scents) bootstrap(scent, from);
}

void Diffusion::bootstrap(const Scent& scent, AgentId from) {
  const AgentId self = ants_.node.self;
  if (scent.target.destination == self || scent.next_hop == self) return;
  if (scent.target.destination == from) return;  // the direct trail is better
  const double pheromone = 1 / (1 / scent.pheromone + ants_.hop_cost());  // (A6)
  ants_.node.count(ProtocolEvent::kPheromoneBootstrapped);
  const Trail* const trail = scent.is_virtual ? nullptr : ants_.table.find(scent.target, from);
  if (trail != nullptr && trail->regular > 0) {
    ants_.table.lay({scent.target.topic, scent.target.destination, from, trail->path}, pheromone,
                    ants_.config().pheromone_weight);
    return;
  }
  ants_.table.set_virtual(scent.target, from, pheromone);
}

void Diffusion::know(const Target& target) {
  const auto neighbour = neighbours_.find(target.destination);
  if (neighbour == neighbours_.end()) return;
  const Trail* const direct = ants_.table.find(target, target.destination);
  if (direct != nullptr && direct->regular > 0) return;
  ants_.table.lay({target.topic, target.destination, target.destination, neighbour->second},
                  ants_.pheromone_of(neighbour->second), 0);
}

}  // namespace hal::node::routing::anthocnet
