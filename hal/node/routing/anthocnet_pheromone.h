#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/node/routing/anthocnet_packet.h"
#include "hal/node/routing/ports.h"
#include "hal/types/random.h"

namespace hal::node::routing::anthocnet {

/// Pheromone and statistics of one next hop towards a target.
struct Trail {
  AgentId next_hop;
  double regular = 0;  ///< 1/s, laid by ants; 0: none, and messages do not use this trail.
  /// 1/s, virtual: derived from hellos; 0: none. For proactive ants only.
  double bootstrapped = 0;
  PathStatistics path;  ///< As the last ant found it; undefined without regular pheromone.
};

/// Weight of a trail in a choice, >= 0; 0: never chosen.
using Weight = double (*)(const Trail&);

/// A regular trail that was removed.
struct Loss {
  Target target;
  PathStatistics path;
  bool was_best = false;  ///< No other trail had as much regular pheromone.
};

/// The pheromone table of one node, by target and next hop: T_nd of (A4) and virtual pheromone
/// (A6). Regular trails are the node's routes; their changes are reported to the observer in the
/// order of (topic, destination, next hop). Numbers of formulae: anthocnet_config.h.
class PheromoneTable {
 public:
  explicit PheromoneTable(RoutingObserver& observer) : observer_(observer) {}

  /// Lays regular pheromone (> 0, 1/s) by (A4) with gamma = `weight` (0..1); a new trail gets the
  /// full amount. No effect if it would start a class beyond RouteTable::kMostClasses.
  void lay(const Route& route, double pheromone, double weight);
  /// Replaces virtual pheromone (> 0, 1/s).
  void set_virtual(const Target& target, AgentId next_hop, double pheromone);

  /// Removes a trail with both its pheromones. @return its regular part, if there was one.
  std::optional<Loss> remove(const Target& target, AgentId next_hop);
  /// Removes all trails via this neighbour. @return the regular ones, by target.
  std::vector<Loss> remove_via(AgentId next_hop);
  /// Removes all trails of a target.
  void remove(const Target& target);

  /// By next hop; empty if there are none.
  std::vector<Trail> trails(const Target& target) const;
  /// Valid until the table changes; null if there is none.
  const Trail* find(const Target& target, AgentId next_hop) const;
  bool has_regular(const Target& target) const { return best_regular(target) != nullptr; }
  /// The first of the trails with the most regular pheromone, valid until the table changes; null
  /// if there is none.
  const Trail* best_regular(const Target& target) const;
  /// The same for virtual pheromone.
  const Trail* best_virtual(const Target& target) const;
  /// All targets with any pheromone, in order.
  std::vector<Target> targets() const;

  std::vector<Route> routes(std::string_view topic, AgentId destination) const;
  std::vector<Route> routes() const;

 private:
  using Trails = std::map<AgentId, Trail>;

  const Trails& trails_to(const Target& target) const;
  const Trail* best(const Target& target, Weight weight) const;
  Trail* trail_at(const Target& target, AgentId next_hop);
  Loss loss_of(const Target& target, const Trails& trails, const Trail& lost) const;
  void report_removed(const Target& target, AgentId next_hop) const;

  RoutingObserver& observer_;
  /// No map in it is empty.
  std::map<std::string, std::map<AgentId, Trails>, std::less<>> classes_;
};

double regular_weight(const Trail& trail);
double any_weight(const Trail& trail);  ///< The greater of regular and virtual.

/// Draws a next hop by (A5) with `weight` as T_nd, among the trails that have a weight above 0 and
/// are not in `avoided`.
/// @param beta  0..100.
/// @return nullopt if there is none. Draws from `random` only if there are two or more.
std::optional<AgentId> pick(const std::vector<Trail>& trails, Weight weight, double beta,
                            const std::vector<AgentId>& avoided, RandomStream& random);

}  // namespace hal::node::routing::anthocnet
