#pragma once

#include <map>

#include "hal/api/robot.h"
#include "hal/types/path_metric.h"

namespace controllers {

/// The motes that have called for help lately: the set HD of Labella, Dietrich, Dressler, "Hybrid
/// simulation of Sensor and Actor Networks with BARAKA", 2009, section 6.2.
class Requesters {
 public:
  void heard(hal::AgentId mote, hal::Time now) { last_heard_[mote] = now; }
  void forget(hal::AgentId mote) { last_heard_.erase(mote); }
  /// Those whose last call came before `time`.
  void forget_before(hal::Time time);
  bool empty() const { return last_heard_.empty(); }

  /// Draws one: P(d) = v(d)^beta / sum, v(d) = r(.) of the best route of the class "help" to d. A
  /// mote to which no route is known counts as much as the worst of the others, so that all count
  /// the same where none is known.
  /// @param metric  r; a mote that can be heard directly is one hop away, and no exception.
  /// @pre !empty()
  hal::AgentId draw(hal::Robot& robot, hal::PathMetric metric, double beta) const;

 private:
  std::map<hal::AgentId, hal::Time> last_heard_;
};

}  // namespace controllers
