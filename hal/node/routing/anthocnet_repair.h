#pragma once

#include <map>

#include "hal/node/routing/anthocnet_ants.h"
#include "hal/node/routing/anthocnet_backlog.h"
#include "hal/node/routing/anthocnet_losses.h"

namespace hal::node::routing::anthocnet {

/// Local repair ([PPSN], 3.4): a relay that lost its only trail to a target while forwarding a
/// message sends a repair ant and keeps the messages. If the ant does not return within repair_wait
/// times the delay of the lost path, plus jitter_max for each of its broadcasts, the messages end
/// with kNoRoute and the neighbours are notified.
class Repair {
 public:
  Repair(AntNode ants, Ants& traffic, Backlog& backlog, Losses& losses)
      : ants_(ants), traffic_(traffic), backlog_(backlog), losses_(losses) {}

  /// @return whether a repair is running now; false: repair_broadcasts is 0.
  bool begin(const Target& target);
  bool is_on(const Target& target) const { return repairs_.contains(target); }

  /// Regular pheromone for the target was laid.
  void on_trail(const Target& target);

 private:
  Duration patience(const Target& target) const;
  void on_timeout(const Target& target);

  AntNode ants_;
  Ants& traffic_;
  Backlog& backlog_;
  Losses& losses_;
  std::map<Target, OwnTimers::Handle> repairs_;  ///< Time-outs of the repairs.
};

}  // namespace hal::node::routing::anthocnet
