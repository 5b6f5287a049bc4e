#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hal/node/routing/ports.h"
#include "hal/types/message.h"
#include "hal/types/route.h"

namespace hal::node::routing {

/// The routes of one node: per message class and destination, every next hop that leads there.
/// Reports each change to the observer, in the order of (topic, destination, next hop).
class RouteTable {
 public:
  explicit RouteTable(RoutingObserver& observer) : observer_(observer) {}

  /// Maximum number of message classes with routes: those of 64 agents with the permitted number of
  /// topics each. Ants come from any node; without a limit they could exhaust the memory.
  static constexpr std::size_t kMostClasses = 64 * kMaxTopics;

  /// Adds an entry, or replaces the path of the entry with this next hop. No effect if it would
  /// start a class and there are kMostClasses.
  void install(const Route& route);

  /// Removes every route of a class to a destination.
  void remove(std::string_view topic, AgentId destination);

  /// Removes every route via this neighbour.
  void remove_via(AgentId next_hop);

  /// By next hop; empty if there is none.
  std::vector<Route> routes(std::string_view topic, AgentId destination) const;
  /// All, by topic, destination and next hop.
  std::vector<Route> routes() const;

 private:
  using Paths = std::map<AgentId, PathStatistics>;
  using Destinations = std::map<AgentId, Paths>;

  void report_removed(std::string_view topic, AgentId destination, AgentId next_hop) const;

  RoutingObserver& observer_;
  std::map<std::string, Destinations, std::less<>> classes_;
};

}  // namespace hal::node::routing
