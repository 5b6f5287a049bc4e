#include "hal/node/routing/anthocnet_repair.h"

namespace hal::node::routing::anthocnet {

bool Repair::begin(const Target& target) {
  if (ants_.config().repair_broadcasts == 0) return false;
  if (repairs_.contains(target)) return true;
  Node& node = ants_.node;
  repairs_[target] =
      node.timers.schedule(node.now() + patience(target), [this, target] { on_timeout(target); });
  losses_.hold(target);
  traffic_.launch(target, AntKind::kRepair);
  return true;
}

Duration Repair::patience(const Target& target) const {
  const PathStatistics* lost = losses_.last_path(target);
  const double delay = lost == nullptr ? 0 : to_seconds(lost->delay);
  const Duration jitter = ants_.node.config.jitter_max * ants_.config().repair_broadcasts;
  return from_seconds(ants_.config().repair_wait * delay) + jitter;
}

void Repair::on_trail(const Target& target) {
  const auto repair = repairs_.extract(target);
  if (repair.empty()) return;
  ants_.node.timers.cancel(repair.mapped());
  ants_.node.count(ProtocolEvent::kRepairSucceeded);
  losses_.release(target);
}

void Repair::on_timeout(const Target& target) {
  repairs_.erase(target);
  ants_.node.count(ProtocolEvent::kRepairFailed);
  backlog_.abandon(target, Verdict::kNoRoute);
  losses_.release(target);
}

}  // namespace hal::node::routing::anthocnet
