#pragma once

#include "hal/node/devices/robot_description.h"
#include "hal/types/geometry.h"
#include "hal/types/time.h"

namespace hal::node::devices {

/// Limits the acceleration with which the motors' velocity approaches a command.
///
/// The linear velocity moves on a straight line from the old vector to the commanded one: at the
/// braking limit while its magnitude decreases, then at the speeding-up limit. The rotation does
/// the same in one dimension. Otherwise a step reversal would make a three-wheeled base yaw
/// (docs/models.md, 1).
class MotorProfile {
 public:
  explicit MotorProfile(const AccelerationLimits& limits) : limits_(limits) {}

  /// @param target  commanded velocity, body frame. @param step  > 0.
  /// @return the velocity to request from the motors from now on.
  Twist2 advance(const Twist2& target, Duration step);

  const Twist2& velocity() const { return velocity_; }
  void reset(const Twist2& velocity) { velocity_ = velocity; }

 private:
  AccelerationLimits limits_;
  Twist2 velocity_;
};

}  // namespace hal::node::devices
