#pragma once

#include "hal/node/devices/wheel_drive.h"
#include "hal/types/geometry.h"

namespace hal::robot::drivers {

/// The operator's limits for a robot, in addition to those of its motors. Infinite: no limit.
struct SpeedLimits {
  double linear;   ///< m/s, > 0, of the magnitude of the velocity
  double angular;  ///< rad/s, > 0
  SpeedLimits();
  SpeedLimits(double linear_limit, double angular_limit)
      : linear(linear_limit), angular(angular_limit) {}
  bool operator==(const SpeedLimits&) const = default;
};

/// The fastest velocity in the direction of `body` (all three components scaled by one factor)
/// within the limits and the speed limit of every wheel. `saturated`: it was scaled.
/// @pre every component is finite.
node::devices::WheelDrive::Limited limited(const Twist2& body,
                                           const node::devices::WheelDrive& wheels,
                                           const SpeedLimits& limits);

}  // namespace hal::robot::drivers
