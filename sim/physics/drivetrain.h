#pragma once

#include <ode/ode.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hal/node/devices/motor_profile.h"
#include "hal/node/devices/robot_description.h"
#include "hal/node/devices/wheel_drive.h"
#include "sim/physics/casters.h"
#include "sim/physics/ode_world.h"
#include "sim/physics/rigid_body.h"
#include "sim/physics/wheels.h"

namespace sim::physics {

/// Drives one robot: commands pass through the motor profile to the wheels.
class Drivetrain {
 public:
  /// @throws std::invalid_argument  the wheels do not make a drive.
  Drivetrain(const OdeWorld& world, const RigidBody& chassis,
             const hal::node::devices::RobotDescription& robot, const WorldConfig& config);

  const hal::node::devices::WheelDrive& drive() const { return drive_; }

  /// Sets the velocity to approach from now on, within the motors' limit.
  void command(const hal::Twist2& target) { target_ = target; }

  /// Off: the wheels roll freely. Both set the command to zero.
  void set_power(bool on);

  /// Call before a step: sets the motors to the next velocity of the profile. A robot that is
  /// commanded to move is kept awake; any other may fall asleep.
  void actuate(hal::Duration step);

  /// Adds contact joints of the wheels with the ground.
  void touch_ground(const OdeWorld& world);

  /// Call after a step: updates the wheels' angles.
  void follow(hal::Duration step);

  const Wheels& wheels() const { return *wheels_; }
  std::span<const double> angles() const { return angles_; }      ///< rad
  const std::vector<dBodyID>& bodies() const { return bodies_; }  ///< Chassis first.

 private:
  void keep_awake(bool moving);

  hal::node::devices::WheelDrive drive_;
  hal::node::devices::MotorProfile profile_;
  RigidBody chassis_;
  std::unique_ptr<Wheels> wheels_;
  std::vector<dBodyID> bodies_;
  Casters casters_;
  std::vector<double> angles_;
  std::vector<double> speeds_;  ///< rad/s, last set on the motors.
  /// Velocity for which these speeds were set; nullopt: not set yet.
  std::optional<hal::Twist2> asked_for_;
  hal::Twist2 target_;
  bool moving_ = false;
};

}  // namespace sim::physics
