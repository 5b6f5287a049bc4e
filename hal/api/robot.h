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

/// A scan of a laser scanner.
struct Scan {
  std::span<const double> headings;  ///< rad in the scanner's frame, ascending.
  /// m, one per heading; NaN: nothing within reach; -infinity: too near to be measured.
  std::span<const double> ranges;
};

/// A reading of an inertial measurement unit, in its own frame.
struct Imu {
  Vec3 angular_velocity;  ///< rad/s
  Vec3 specific_force;    ///< m/s^2, mean since the control cycle before; at rest gravity, upwards.
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

  /// The readings of the channels "scan", "imu", "bumper" and "pose"; those of further sensors of
  /// the same kinds, under other names, come from reading(name). A scan is valid until the callback
  /// returns. Errors, of all four: kNotAvailable (no such sensor, not asked for, not sampled yet,
  /// or lost).
  virtual Result<Scan> scan() const = 0;
  virtual Result<Imu> imu() const = 0;
  /// Whether the body has touched anything since the control cycle before.
  virtual Result<bool> bumped() const = 0;
  /// Where the body is in the world, as a compass and a position fix tell, with their noise.
  virtual Result<Pose2> pose() const = 0;
};

}  // namespace hal
