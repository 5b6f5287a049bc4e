#pragma once

#include <cstdint>
#include <vector>

#include "hal/types/time.h"
#include "sim/agents/observer.h"
#include "sim/physics/world.h"

namespace sim::agents {

/// Reports the movables of a world to observers: all at the start, and then in each period those
/// that have moved since their last report.
class MovableWatch {
 public:
  /// @param world  outlives this object. @param period  > 0.
  MovableWatch(const physics::World& world, hal::Duration period);

  /// Reports all. Call before the first step.
  void start(hal::Time now, Observer& observer);
  /// Call after each step of the world.
  void on_step(hal::Time now, Observer& observer);

 private:
  const physics::World& world_;
  hal::Duration period_;
  hal::Time due_{};
  std::vector<bool> has_moved_;  ///< By number, since the last report.
};

}  // namespace sim::agents
