#pragma once

#include <span>

#include "hal/api/real_world_object.h"
#include "hal/types/geometry.h"
#include "hal/types/result.h"

namespace hal {

/// What a drive command came to.
struct Drive {
  Twist2 applied;          ///< What the motors will be asked for, body frame.
  bool saturated = false;  ///< The command was beyond a motor's limit and was scaled down.
  /// Part of the command was not feasible and was left out: the sideways part for a robot on two
  /// fixed wheels.
  bool restricted = false;
};

/// One infrared ranging sensor.
struct InfraredReading {
  double heading = 0;  ///< rad in the body frame.
  double range = 0;    ///< m to the nearest surface; NaN: nothing within reach.
};

/// Odometry: dead reckoning from the wheels since the start of the run.
struct Odometry {
  Pose2 pose;    ///< In the frame the body had at the start.
  Twist2 twist;  ///< Body frame.
};

class Robot : public RealWorldObject {
 public:
  /// Drives with a velocity of the body, until the next command. What the robot's wheels cannot do
  /// is left out; then, if a wheel would exceed its limit, all three components are scaled by the
  /// same factor: the direction is kept. Errors: kInvalidArgument (NaN or infinite).
  virtual Result<Drive> set_body_velocity(const Twist2& twist) = 0;

  /// @param speeds  rad/s of each driven wheel about its axle, in the order of the robot's file.
  /// Errors: kInvalidArgument (count, NaN, beyond the limit: refused, not scaled).
  virtual Result<void> set_wheel_speeds(std::span<const double> speeds) = 0;

  /// Errors: kNotAvailable (no infrared, not asked for, not sampled yet, or lost: on hardware the
  /// sensors have not answered for the `stale_after` of the robot's file).
  virtual Result<std::vector<InfraredReading>> infrared() const = 0;
  virtual Result<Odometry> odometry() const = 0;
};

}  // namespace hal
