#include "hal/node/routing/anthocnet_sessions.h"

namespace hal::node::routing::anthocnet {

void Sessions::on_message(const Target& target) {
  if (ants_.config().proactive_period == Duration::zero()) return;
  const bool is_new = last_message_.insert_or_assign(target, ants_.node.now()).second;
  if (is_new) wait(target);
}

/// Up to a quarter of the period early, so that sessions that begin together do not stay in step.
void Sessions::wait(const Target& target) {
  Node& node = ants_.node;
  const auto period = static_cast<double>(ants_.config().proactive_period.count());
  const double early = 0.25 * node.random.uniform() * period;
  node.timers.schedule(node.now() + Duration{static_cast<std::int64_t>(period - early)},
                       [this, target] { on_period(target); });
}

void Sessions::on_period(const Target& target) {
  const Time last = last_message_.at(target);
  if (ants_.node.now() - last > ants_.config().session_timeout) {
    last_message_.erase(target);
    return;
  }
  if (is_promising(target)) traffic_.launch(target, AntKind::kProactive);
  wait(target);
}

bool Sessions::is_promising(const Target& target) const {
  const Trail* const regular = ants_.table.best_regular(target);
  if (regular == nullptr) return false;  // path setup is in progress
  const double margin = ants_.config().proactive_margin;
  if (margin == 0) return true;
  const Trail* const bootstrapped = ants_.table.best_virtual(target);
  return bootstrapped != nullptr && bootstrapped->bootstrapped >= margin * regular->regular;
}

}  // namespace hal::node::routing::anthocnet
