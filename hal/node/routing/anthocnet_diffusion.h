#pragma once

#include <functional>
#include <map>

#include "hal/node/routing/anthocnet_node.h"
#include "hal/node/routing/hello.h"

namespace hal::node::routing::anthocnet {

/// Hellos that carry pheromone. Every hello_period, shortened at random by up to a quarter, a node
/// broadcasts its best pheromone for up to hello_destinations targets, drawn at random if it knows
/// more. A receiver of v for a target computes v' by (A6): virtual pheromone, which guides
/// proactive ants but not messages. If the receiver has regular pheromone via that neighbour and
/// the reported one is regular, too, v' is a new sample of it ([ETT], 3.4). A receiver ignores
/// reports of paths that lead through itself. Numbers of formulae: anthocnet_config.h.
///
/// Hellos also announce neighbours: a direct trail to a neighbour is laid when it is needed.
class Diffusion {
 public:
  /// @param on_silence  called once when a neighbour has been silent for too long (hello.h).
  Diffusion(AntNode ants, bool watches, Link& link, std::function<void(AgentId)> on_silence);

  /// Sends the first hello after a random part of the period.
  void start();

  /// Any frame shows that its transmitter is alive.
  void on_heard(AgentId from);
  void on_hello(const PheromoneHello& hello, const Arrival& arrival);
  void forget(AgentId neighbour) { neighbours_.erase(neighbour); }

  /// Lays a direct trail if the target is a neighbour and there is none yet.
  void know(const Target& target);

 private:
  void send();
  std::vector<Scent> scents();
  void bootstrap(const Scent& scent, AgentId from);

  AntNode ants_;
  /// Whether silent neighbours are detected here. Without transmit status HopLayer detects them.
  const bool watches_;
  Hellos watch_;
  /// Statistics of the hop to each neighbour from which a hello was received.
  std::map<AgentId, PathStatistics> neighbours_;
};

}  // namespace hal::node::routing::anthocnet
