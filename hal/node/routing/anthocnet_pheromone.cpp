#include "hal/node/routing/anthocnet_pheromone.h"

#include <algorithm>

#include "hal/node/routing/route_table.h"
#include "hal/types/math.h"

namespace hal::node::routing::anthocnet {
namespace {

Route route_of(const Target& target, const Trail& trail) {
  return {target.topic, target.destination, trail.next_hop, trail.path};
}

/// The first trail with the greatest weight; null if all weights are 0.
class Best {
 public:
  explicit Best(Weight weight) : weight_(weight) {}
  void consider(const Trail& trail) {
    const double weight = weight_(trail);
    if (weight <= most_) return;
    most_ = weight;
    found_ = &trail;
  }
  const Trail* found() const { return found_; }

 private:
  Weight weight_;
  double most_ = 0;
  const Trail* found_ = nullptr;
};

double virtual_weight(const Trail& trail) { return trail.bootstrapped; }

}  // namespace

Trail* PheromoneTable::trail_at(const Target& target, AgentId next_hop) {
  const bool is_full = classes_.size() >= RouteTable::kMostClasses;
  if (is_full && !classes_.contains(target.topic)) return nullptr;
  Trail& trail = classes_[target.topic][target.destination][next_hop];
  trail.next_hop = next_hop;
  return &trail;
}

void PheromoneTable::lay(const Route& route, double pheromone, double weight) {
  Trail* trail = trail_at({route.topic, route.destination}, route.next_hop);
  if (trail == nullptr) return;
  const bool is_new = trail->regular == 0;
  // (A4)
  trail->regular = is_new ? pheromone : weight * trail->regular + (1 - weight) * pheromone;
  if (!is_new && trail->path == route.path) return;
  trail->path = route.path;
  observer_.on_route_change({.route = route, .removed = false});
}

void PheromoneTable::set_virtual(const Target& target, AgentId next_hop, double pheromone) {
  if (Trail* trail = trail_at(target, next_hop)) trail->bootstrapped = pheromone;
}

Loss PheromoneTable::loss_of(const Target& target, const Trails& trails, const Trail& lost) const {
  const bool was_best = std::ranges::none_of(
      trails, [&lost](const auto& other) { return other.second.regular > lost.regular; });
  return {target, lost.path, was_best};
}

std::optional<Loss> PheromoneTable::remove(const Target& target, AgentId next_hop) {
  const auto destinations = classes_.find(target.topic);
  if (destinations == classes_.end()) return std::nullopt;
  const auto trails = destinations->second.find(target.destination);
  if (trails == destinations->second.end()) return std::nullopt;
  const auto found = trails->second.find(next_hop);
  if (found == trails->second.end()) return std::nullopt;
  std::optional<Loss> loss;
  if (found->second.regular > 0) loss = loss_of(target, trails->second, found->second);
  trails->second.erase(found);
  if (trails->second.empty()) destinations->second.erase(trails);
  if (destinations->second.empty()) classes_.erase(destinations);
  if (loss) report_removed(target, next_hop);
  return loss;
}

std::vector<Loss> PheromoneTable::remove_via(AgentId next_hop) {
  std::vector<Loss> losses;
  for (const Target& target : targets()) {
    if (auto loss = remove(target, next_hop)) losses.push_back(std::move(*loss));
  }
  return losses;
}

void PheromoneTable::remove(const Target& target) {
  for (const Trail& trail : trails(target)) remove(target, trail.next_hop);
}

const PheromoneTable::Trails& PheromoneTable::trails_to(const Target& target) const {
  static const Trails none;
  const auto destinations = classes_.find(target.topic);
  if (destinations == classes_.end()) return none;
  const auto trails = destinations->second.find(target.destination);
  return trails == destinations->second.end() ? none : trails->second;
}

std::vector<Trail> PheromoneTable::trails(const Target& target) const {
  const Trails& known = trails_to(target);
  std::vector<Trail> found;
  found.reserve(known.size());
  for (const auto& [next_hop, trail] : known) found.push_back(trail);
  return found;
}

const Trail* PheromoneTable::find(const Target& target, AgentId next_hop) const {
  const Trails& known = trails_to(target);
  const auto found = known.find(next_hop);
  return found == known.end() ? nullptr : &found->second;
}

const Trail* PheromoneTable::best(const Target& target, Weight weight) const {
  Best best(weight);
  for (const auto& [next_hop, trail] : trails_to(target)) best.consider(trail);
  return best.found();
}

const Trail* PheromoneTable::best_regular(const Target& target) const {
  return best(target, regular_weight);
}

const Trail* PheromoneTable::best_virtual(const Target& target) const {
  return best(target, virtual_weight);
}

std::vector<Target> PheromoneTable::targets() const {
  std::vector<Target> found;
  for (const auto& [topic, destinations] : classes_) {
    for (const auto& [destination, trails] : destinations) found.push_back({topic, destination});
  }
  return found;
}

std::vector<Route> PheromoneTable::routes(std::string_view topic, AgentId destination) const {
  const Target target{std::string(topic), destination};
  std::vector<Route> found;
  for (const Trail& trail : trails(target)) {
    if (trail.regular > 0) found.push_back(route_of(target, trail));
  }
  return found;
}

std::vector<Route> PheromoneTable::routes() const {
  std::vector<Route> found;
  for (const Target& target : targets()) {
    for (Route& route : routes(target.topic, target.destination)) found.push_back(std::move(route));
  }
  return found;
}

void PheromoneTable::report_removed(const Target& target, AgentId next_hop) const {
  observer_.on_route_change(
      {.route = {target.topic, target.destination, next_hop, {}}, .removed = true});
}

double regular_weight(const Trail& trail) { return trail.regular; }

double any_weight(const Trail& trail) { return std::max(trail.regular, trail.bootstrapped); }

std::optional<AgentId> pick(const std::vector<Trail>& trails, Weight weight, double beta,
                            const std::vector<AgentId>& avoided, RandomStream& random) {
  std::vector<Trail> choices;
  for (const Trail& trail : trails) {
    if (weight(trail) <= 0) continue;
    if (std::ranges::find(avoided, trail.next_hop) == avoided.end()) choices.push_back(trail);
  }
  if (choices.empty()) return std::nullopt;
  if (choices.size() == 1) return choices.front().next_hop;

  // (A5), with weights relative to the greatest, so that no power overflows.
  Best most(weight);
  for (const Trail& trail : choices) most.consider(trail);
  const double best = weight(*most.found());
  std::vector<double> share;
  double total = 0;
  for (const Trail& trail : choices) {
    share.push_back(math::pow(weight(trail) / best, beta));
    total += share.back();
  }
  double left = random.uniform() * total;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    left -= share[i];
    if (left < 0) return choices[i].next_hop;
  }
  return choices.back().next_hop;  // rounding left a remainder
}

}  // namespace hal::node::routing::anthocnet
