#pragma once

#include <map>
#include <string>

#include "hal/node/routing/forwarding.h"

namespace hal::node::routing {

/// Relays and answers ants, and writes the routes they find into the table.
///
/// A forward ant installs no routes by itself. Its backward ant installs, at every node of the
/// path, the route to the node that was searched and the route to the node that searched; the
/// latter also at the node that answers, so that a reply needs no search of its own.
class Ants {
 public:
  Ants(Node& node, RouteTable& table, Outbox& outbox, Forwarding& forwarding)
      : node_(node), table_(table), outbox_(outbox), forwarding_(forwarding) {}

  /// @return false if the ant contradicts its reception, e.g. its transmitter.
  bool on_forward_ant(ForwardAnt ant, const Arrival& arrival);
  bool on_backward_ant(BackwardAnt ant, const Arrival& arrival);

 private:
  /// State of the copies of one forward ant.
  struct Visit {
    int best_hops = 0;
    Duration best_time{};
    /// Path to its source, by neighbour from which a copy was accepted.
    std::map<AgentId, PathStatistics> back;
  };
  using AntId = std::pair<AgentId, Sequence>;

  Visit* accept(const ForwardAnt& ant);
  void answer(const ForwardAnt& ant);
  void relay(ForwardAnt ant);
  void teach_way_back(const BackwardAnt& ant);
  void walk_on(BackwardAnt ant);

  Node& node_;
  RouteTable& table_;
  Outbox& outbox_;
  Forwarding& forwarding_;
  Memory<AntId, Visit> visits_;
};

}  // namespace hal::node::routing
