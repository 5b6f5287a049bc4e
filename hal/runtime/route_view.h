#pragma once

#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "hal/exchange/step.h"
#include "hal/types/agent_id.h"
#include "hal/types/route.h"

namespace hal::runtime {

/// The routes and neighbours of an agent as its controller knows them: the sum of the changes that
/// its events brought.
class RouteView {
 public:
  /// @param watched  topics the controller asked for; routes of others are not kept.
  RouteView(std::vector<std::string> watched, bool neighbours)
      : watched_(std::move(watched)), keeps_neighbours_(neighbours) {}

  void take_in(const exchange::Event& event);

  /// By next hop.
  std::vector<Route> routes(std::string_view topic, AgentId destination) const;

  /// By address.
  const std::vector<Neighbour>& neighbours() const { return neighbours_; }

  void forget(std::string_view topic, AgentId destination);

 private:
  using Key = std::tuple<std::string, AgentId, AgentId>;  ///< topic, destination, next hop
  using Table = std::map<Key, PathStatistics>;

  bool is_watched(const std::string& topic) const;
  void update_neighbour(const Neighbour& neighbour);

  std::vector<std::string> watched_;
  bool keeps_neighbours_;
  Table table_;
  std::vector<Neighbour> neighbours_;
};

}  // namespace hal::runtime
