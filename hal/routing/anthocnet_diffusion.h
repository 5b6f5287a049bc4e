#pragma once

#include <functional>
#include <map>

#include "hal/routing/anthocnet_node.h"
#include "hal/routing/hello.h"

namespace hal::routing::anthocnet {

/// Hellos that carry pheromone: every hello_period, less a random quarter of it at most, a node
/// broadcasts the best pheromone it has for up to hello_destinations targets, drawn at random if it
/// knows more. Whoever hears v for a target bootstraps v' = 1 / (1 / v + cost of the hop between):
/// virtual pheromone, which guides proactive ants but no message. Where an ant has already laid
/// regular pheromone over that neighbour, and the neighbour's is regular too, v' is a new sample of
/// it ([ETT], 3.4). A neighbour whose best path leads over the listener teaches it nothing.
///
/// Hellos also tell who the neighbours are: a direct trail to each is there when it is asked for.
class Diffusion {
 public:
  /// @param on_silence  called once when a neighbour has been silent for too long (hello.h).
  Diffusion(AntNode ants, bool watches, Link& link, std::function<void(AgentId)> on_silence);

  /// Sends the first hello after a random part of the period.
  void start();

  /// Any frame is a sign of life.
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
  const bool watches_;  ///< Nobody below does.
  Hellos watch_;
  std::map<AgentId, PathStatistics> neighbours_;  ///< The hop to each whose hello was heard.
};

}  // namespace hal::routing::anthocnet
