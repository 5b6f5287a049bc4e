#pragma once

#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "hal/node/exchange/step.h"
#include "hal/types/agent_id.h"
#include "hal/types/route.h"

namespace gateway::runtime {

/// The routes and neighbours of an agent as its controller knows them: the accumulated changes of
/// its events.
class RouteView {
 public:
  /// @param watched  topics to which the controller subscribes; routes of others are not kept.
  RouteView(std::vector<std::string> watched, bool neighbours)
      : watched_(std::move(watched)), keeps_neighbours_(neighbours) {}

  void take_in(const hal::node::exchange::Event& event);

  /// Sorted by next hop.
  std::vector<hal::Route> routes(std::string_view topic, hal::AgentId destination) const;

  /// Sorted by address.
  const std::vector<hal::Neighbour>& neighbours() const { return neighbours_; }

  void forget(std::string_view topic, hal::AgentId destination);

 private:
  /// Topic, destination, next hop.
  using Key = std::tuple<std::string, hal::AgentId, hal::AgentId>;
  using Table = std::map<Key, hal::PathStatistics>;

  bool is_watched(const std::string& topic) const;
  void update_neighbour(const hal::Neighbour& neighbour);

  std::vector<std::string> watched_;
  bool keeps_neighbours_;
  Table table_;
  std::vector<hal::Neighbour> neighbours_;
};

}  // namespace gateway::runtime
