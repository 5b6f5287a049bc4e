#pragma once

#include <set>

#include "hal/routing/anthocnet_diffusion.h"
#include "hal/routing/memory.h"

namespace hal::routing::anthocnet {

/// Who hears what the ants bring.
class AntListener {
 public:
  virtual ~AntListener() = default;
  /// An ant that this node launched came back.
  virtual void on_home(const Target& target, AntKind kind, Sequence sequence) = 0;
  /// Regular pheromone for the target was laid here. After on_home.
  virtual void on_trail(const Target& target) = 0;
};

/// Launches ants, passes them on, answers them, and lays the pheromone that those who come back
/// bring ([PPSN], 3.1 and 3.3; [ETT], 3.2 and 3.4).
///
/// A forward ant goes from node to node where it finds pheromone (regular; a proactive ant goes by
/// the greater of regular and virtual), picked at random, never to a node it has been at; else it
/// is broadcast: a reactive one by each node `copies` times at most, the others only as often as
/// their budget allows, and then they die. Its answer walks its path back and lays, at each node,
/// pheromone towards the node that was looked for.
class Ants {
 public:
  Ants(AntNode ants, Diffusion& diffusion, AntListener& listener)
      : ants_(ants), diffusion_(diffusion), listener_(listener) {}

  /// Sends an ant off. @return its number; numbers grow.
  Sequence launch(const Target& target, AntKind kind);

  /// @return false if the ant contradicts how it came in.
  bool on_forward_ant(ForwardAnt ant, const Arrival& arrival);
  bool on_backward_ant(BackwardAnt ant, const Arrival& arrival);

 private:
  /// What is kept of the copies of one forward ant that were taken.
  struct Visit {
    int best_hops = 0;
    Duration best_time{};
    std::set<AgentId> first_hops;
    int broadcasts = 0;  ///< By this node.
  };

  Visit* accept(const ForwardAnt& ant);
  void answer(const ForwardAnt& ant);
  void pass_on(ForwardAnt ant, Visit& visit);
  std::optional<AgentId> next_hop_of(const ForwardAnt& ant);
  bool may_broadcast(const ForwardAnt& ant, const Visit& visit) const;

  AntNode ants_;
  Diffusion& diffusion_;
  AntListener& listener_;
  Memory<std::pair<AgentId, Sequence>, Visit> visits_;
};

}  // namespace hal::routing::anthocnet
