#pragma once

#include <set>

#include "hal/node/routing/anthocnet_diffusion.h"
#include "hal/node/routing/memory.h"

namespace hal::node::routing::anthocnet {

/// Receives the results of ants.
class AntListener {
 public:
  virtual ~AntListener() = default;
  /// An ant that this node launched has returned.
  virtual void on_home(const Target& target, AntKind kind, Sequence sequence) = 0;
  /// Regular pheromone for the target was laid at this node. Called after on_home.
  virtual void on_trail(const Target& target) = 0;
};

/// Sends, forwards and answers ants, and lays pheromone when backward ants pass ([PPSN], 3.1 and
/// 3.3; [ETT], 3.2 and 3.4).
///
/// A forward ant is unicast where there is pheromone: regular, or for a proactive ant the greater
/// of regular and virtual. Its next hop is drawn by (A5), never a node that it has visited.
/// Otherwise it is broadcast: each node broadcasts at most `copies` copies of an ant, and a
/// proactive or repair ant also has a limited number of broadcasts over its whole path; beyond
/// these limits it is dropped. The backward ant follows the path in reverse and lays, at each node,
/// pheromone towards the node that was searched. Numbers of formulae: anthocnet_config.h.
class Ants {
 public:
  Ants(AntNode ants, Diffusion& diffusion, AntListener& listener)
      : ants_(ants), diffusion_(diffusion), listener_(listener) {}

  /// Sends a new ant. @return its sequence number; numbers increase.
  Sequence launch(const Target& target, AntKind kind);

  /// @return false if the ant contradicts its reception, e.g. its transmitter.
  bool on_forward_ant(ForwardAnt ant, const Arrival& arrival);
  bool on_backward_ant(BackwardAnt ant, const Arrival& arrival);

 private:
  /// State of the accepted copies of one forward ant.
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

}  // namespace hal::node::routing::anthocnet
