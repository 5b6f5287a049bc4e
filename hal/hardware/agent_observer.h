#pragma once

#include <span>
#include <string>

#include "hal/types/geometry.h"
#include "hal/types/message.h"
#include "hal/types/route.h"
#include "hal/types/time.h"

namespace hal::hardware {

/// What there is to see of a real agent. Called in the loop; must be quick.
class AgentObserver {
 public:
  virtual ~AgentObserver() = default;
  /// Once per control period, whether or not there is a controller: then the others follow.
  virtual void on_cycle(Time at) { (void)at; }
  virtual void on_pose(Time at, const Pose2& pose) { (void)at, (void)pose; }
  virtual void on_odometry(Time at, const Pose2& pose, const Twist2& twist) {
    (void)at, (void)pose, (void)twist;
  }
  /// @param metres  NaN: nothing within reach.
  virtual void on_ranges(Time at, std::span<const double> metres) { (void)at, (void)metres; }
  virtual void on_fate(Time at, MessageId id, Fate fate) { (void)at, (void)id, (void)fate; }
  virtual void on_route_change(Time at, const RouteChange& change) { (void)at, (void)change; }
  virtual void on_state(Time at, const std::string& state) { (void)at, (void)state; }
};

}  // namespace hal::hardware
