#pragma once

#include <set>
#include <span>

#include "hal/node/routing/anthocnet_node.h"
#include "hal/node/routing/memory.h"

namespace hal::node::routing::anthocnet {

/// Handling of lost trails ([PPSN], 3.4; [ETT], 3.5). A node that lost its best or only trail to
/// some targets notifies its neighbours and states the best remaining path. They adjust their
/// trails through that node, and notify their own neighbours if that trail was their best. Targets
/// under repair are left out until the repair has ended.
///
/// Beyond the paper, to prevent counting to infinity: a notice names the next hop of the remaining
/// path, and that neighbour removes its own trail back; and no path exceeds hop_limit.
class Losses {
 public:
  explicit Losses(AntNode ants) : ants_(ants) {}

  void on_link_lost(AgentId neighbour);
  void on_notice(const LossNotice& notice, const Arrival& arrival);
  void on_warning(const Warning& warning, AgentId from);
  /// Warns this neighbour that its message cannot be forwarded from here.
  void warn(AgentId neighbour, const Target& target);

  /// Sends no notice about a target until release().
  void hold(const Target& target) { held_.insert(target); }
  void release(const Target& target);

  /// The path to the target that was lost last; null if that is too long ago.
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
  bool is_waiting_ = false;  ///< A notice is scheduled.
  Memory<Target, PathStatistics> last_;
};

}  // namespace hal::node::routing::anthocnet
