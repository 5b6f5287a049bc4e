#pragma once

#include <set>
#include <span>

#include "hal/routing/anthocnet_node.h"
#include "hal/routing/memory.h"

namespace hal::routing::anthocnet {

/// What a node does about trails that are gone ([PPSN], 3.4; [ETT], 3.5): a node that lost the best
/// or the only way to some targets tells its neighbours, with the best that is left; they adjust
/// what they have over it, and tell theirs if that was their best. Targets whose repair is under
/// way are left out until it is decided.
///
/// Beyond the paper, against counting to infinity: a notice names the next hop of what is left, and
/// that neighbour drops its own trail back; and no path is longer than hop_limit.
class Losses {
 public:
  explicit Losses(AntNode ants) : ants_(ants) {}

  void on_link_lost(AgentId neighbour);
  void on_notice(const LossNotice& notice, const Arrival& arrival);
  void on_warning(const Warning& warning, AgentId from);
  /// A message from this neighbour cannot go on from here.
  void warn(AgentId neighbour, const Target& target);

  /// Says nothing about a target until release().
  void hold(const Target& target) { held_.insert(target); }
  void release(const Target& target);

  /// The path to a target that was lost last; null if that is long ago.
  const PathStatistics* last_path(const Target& target) const { return last_.find(target); }

 private:
  void note(const Loss& loss);
  void tell(const Target& target);
  void send();
  void send(std::span<const LostPath> lost);
  LostPath what_is_left(const Target& target) const;
  void take_worse(const LostPath& lost, const Arrival& arrival);

  AntNode ants_;
  std::set<Target> untold_, held_;
  bool is_waiting_ = false;  ///< A notice is about to be sent.
  Memory<Target, PathStatistics> last_;
};

}  // namespace hal::routing::anthocnet
