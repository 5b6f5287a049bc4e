#pragma once

#include <map>

#include "hal/api/robot.h"
#include "hal/types/path_metric.h"

namespace controllers {

/// Motes that have called for help recently: the set HD of Labella, Dietrich, Dressler, "Hybrid
/// simulation of Sensor and Actor Networks with BARAKA", 2009, section 6.2.
class Requesters {
 public:
  void heard(hal::AgentId mote, hal::Time now) { last_heard_[mote] = now; }
  void forget(hal::AgentId mote) { last_heard_.erase(mote); }
  /// Forgets the motes whose last call came before `time`.
  void forget_before(hal::Time time);
  bool empty() const { return last_heard_.empty(); }

  /// Draws one: P(d) = v(d)^beta / sum over d' of v(d')^beta (as equation 1 of the same paper, but
  /// over destinations), v(d) = r(.) of the best route of the class "help" to d. A mote without a
  /// known route has the v of the worst of the others; without any known route all are equally
  /// probable.
  /// @param metric  r; a direct neighbour counts as one hop, without the exception of
  ///   direct_weight.
  /// @pre !empty()
  hal::AgentId draw(hal::Robot& robot, hal::PathMetric metric, double beta) const;

 private:
  std::map<hal::AgentId, hal::Time> last_heard_;
};

}  // namespace controllers
