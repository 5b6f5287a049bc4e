#pragma once

#include <span>

#include "hal/api/real_world_object.h"
#include "hal/types/geometry.h"
#include "hal/types/result.h"
#include "hal/types/robot_body.h"

namespace hal {

/// Effect of a drive command.
struct Drive {
  Twist2 applied;          ///< Velocity that the motors are to reach, body frame.
  bool saturated = false;  ///< The command exceeded a motor's limit and was scaled down.
  /// Part of the command was not feasible and was left out: the sideways part for a robot on two
  /// fixed wheels.
  bool restricted = false;
};

/// One infrared ranging sensor.
struct InfraredReading {
  double heading = 0;  ///< rad in the body frame.
  double range = 0;    ///< m to the nearest surface; NaN: nothing within range.
};

/// Odometry: dead reckoning from the wheels since the start of the run.
struct Odometry {
  Pose2 pose;    ///< In the frame of the body at the start.
  Twist2 twist;  ///< Body frame.
};

/// A scan of a laser scanner.
struct Scan {
  std::span<const double> headings;  ///< rad in the scanner's frame, ascending.
  /// m, one per heading; NaN: nothing within range; -infinity: too near to be measured.
  std::span<const double> ranges;
};

/// A reading of an inertial measurement unit, in its own frame.
struct Imu {
  Vec3 angular_velocity;  ///< rad/s
  /// m/s^2, mean since the previous control cycle; at rest it equals gravity and points upwards.
  Vec3 specific_force;
};

/// An agent that can drive, with wheels, odometry and the sensors of its file.
class Robot : public RealWorldObject {
 public:
  /// Shape and wheels as the robot's file describes them, valid for the life of the controller.
  /// Masses, meshes and colours are not among them.
  virtual const RobotBody& body() const = 0;

  /// Drives with this velocity of the body until the next command. Components that the robot's
  /// wheels cannot produce are omitted; then, if a wheel would exceed its limit, all three
  /// components are scaled by the same factor, which keeps the direction. Errors: kInvalidArgument
  /// (NaN or infinite).
  virtual Result<Drive> set_body_velocity(const Twist2& twist) = 0;

  /// Turns the driven wheels at these speeds until the next command.
  /// @param speeds  rad/s of each driven wheel about its axle, in the order of the robot's file.
  /// Errors: kInvalidArgument (count, NaN, beyond the limit: refused, not scaled).
  virtual Result<void> set_wheel_speeds(std::span<const double> speeds) = 0;

  /// Latest readings of the infrared ranging sensors.
  /// Errors: kNotAvailable (no infrared, not asked for, not sampled yet, or lost: on hardware the
  /// sensors have not answered for the `stale_after` of the robot's file).
  virtual Result<std::vector<InfraredReading>> infrared() const = 0;
  /// Latest odometry. Errors: kNotAvailable (no odometry, not asked for, not sampled yet, or lost).
  virtual Result<Odometry> odometry() const = 0;

  /// Latest readings of the channels "scan", "imu", "bumper" and "pose"; use reading(name) for
  /// further sensors of the same kinds, which have other names. A scan is valid until the callback
  /// returns. Errors of all four functions: kNotAvailable (no such sensor, not asked for, not
  /// sampled yet, or lost).
  virtual Result<Scan> scan() const = 0;
  /// Rates of turn [rad/s] and specific force [m/s^2], in the frame of the unit.
  virtual Result<Imu> imu() const = 0;
  /// Whether the body has touched anything since the previous control cycle.
  virtual Result<bool> bumped() const = 0;
  /// Pose of the body in the world, as measured by a compass and a position fix, with noise.
  virtual Result<Pose2> pose() const = 0;
};

}  // namespace hal
