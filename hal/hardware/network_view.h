#pragma once

#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "hal/exchange/step.h"
#include "hal/types/route.h"
#include "hal/types/wants.h"

namespace hal::hardware {

/// What the router of this node knows, and which part of it the controller has not been told. A
/// controller that joins late starts with all of it.
class NetworkView {
 public:
  void on_route_change(const RouteChange& change);
  /// Whether the controller has to hear of it now: the neighbour is new to it, and it wants them.
  [[nodiscard]] bool on_neighbour(const Neighbour& neighbour);
  /// Likewise for one that it knew.
  [[nodiscard]] bool on_neighbour_lost(AgentId neighbour);

  /// A controller joins, that knows nothing.
  void start_anew(const Wants& wants);

  /// Puts what the controller has not been told into an event for it.
  void tell(exchange::Event& event);

 private:
  using Key = std::tuple<std::string, AgentId, AgentId>;  ///< Topic, destination, next hop.

  bool is_watched(const std::string& topic) const;

  Wants wants_;
  std::map<Key, Route> routes_;
  std::map<AgentId, Neighbour> neighbours_;
  std::vector<RouteChange> new_routes_;
  std::set<AgentId> heard_, lost_;  ///< Neighbours since the last event.
  std::set<AgentId> told_;          ///< Neighbours that the controller knows, or is about to.
};

}  // namespace hal::hardware
