#include "sim/physics/drivetrain.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace sim::physics {

namespace {

void check(const hal::node::devices::RobotDescription& robot) {
  for (const hal::node::devices::Wheel& wheel : robot.wheels) {
    const bool moves = wheel.max_torque > 0 && wheel.mu > 0;
    if (!(wheel.mass > 0) || !(moves || !wheel.is_driven()) || !(wheel.mu2 >= 0))
      throw std::invalid_argument(
          fmt::format("wheel: mass {} kg, max_torque {} N m, mu {}, mu2 {}: must be positive "
                      "(mu2: or 0)",
                      wheel.mass, wheel.max_torque, wheel.mu, wheel.mu2));
  }
  const auto& a = robot.acceleration;
  for (const double limit : {a.linear_up, a.linear_down, a.angular_up, a.angular_down})
    if (!(limit > 0))
      throw std::invalid_argument(fmt::format("acceleration limit {}: must be positive", limit));
}

std::vector<hal::node::devices::Wheel> driven(
    const std::vector<hal::node::devices::Wheel>& wheels) {
  std::vector<hal::node::devices::Wheel> driven;
  std::ranges::copy_if(wheels, std::back_inserter(driven), &hal::node::devices::Wheel::is_driven);
  return driven;
}

std::unique_ptr<Wheels> make_wheels(const OdeWorld& world, const RigidBody& chassis,
                                    const hal::node::devices::RobotDescription& robot,
                                    const WorldConfig& config) {
  if (robot.wheel_level == hal::node::devices::WheelLevel::kJointed)
    return make_jointed_wheels(world, chassis, driven(robot.wheels), config);
  dMass mass;
  dBodyGetMass(chassis.body, &mass);
  const double weight = mass.mass * config.gravity;
  return make_contact_wheels(chassis, driven(robot.wheels),
                             weight / static_cast<double>(robot.wheels.size()),
                             config.measure_energy);
}

/// A robot with a battery needs the energy of its motors.
WorldConfig measuring_for(const hal::node::devices::RobotDescription& robot, WorldConfig config) {
  config.measure_energy |= hal::node::devices::battery_of(robot.sensors) != nullptr;
  return config;
}

}  // namespace

Drivetrain::Drivetrain(const OdeWorld& world, const RigidBody& chassis,
                       const hal::node::devices::RobotDescription& robot, const WorldConfig& config)
    : drive_(robot.wheels),
      profile_(robot.acceleration),
      chassis_(chassis),
      bodies_{chassis.body},
      casters_(chassis, robot.wheels),
      angles_(drive_.wheel_count(), 0.0),
      speeds_(drive_.wheel_count(), 0.0) {
  check(robot);
  wheels_ = make_wheels(world, chassis, robot, measuring_for(robot, config));
  bodies_.insert(bodies_.end(), wheels_->bodies().begin(), wheels_->bodies().end());
}

void Drivetrain::set_power(bool on) {
  target_ = {};
  profile_.reset({});
  wheels_->set_power(on);
  // A sleeping body would not notice that the motors no longer hold it.
  for (const dBodyID body : bodies_) dBodyEnable(body);
}

void Drivetrain::actuate(hal::Duration step) {
  const hal::Twist2 wanted = profile_.advance(target_, step);
  keep_awake(wanted != hal::Twist2{} || target_ != hal::Twist2{});
  if (wanted == asked_for_) return;
  asked_for_ = wanted;
  // Rotation and translation follow separate ramps, so between two feasible velocities a wheel
  // might still exceed its limit.
  drive_.wheel_speeds(drive_.saturate(wanted).twist, speeds_);
  wheels_->turn(speeds_);
}

void Drivetrain::keep_awake(bool moving) {
  if (moving == moving_) return;
  moving_ = moving;
  for (const dBodyID body : bodies_) {
    dBodySetAutoDisableFlag(body, moving ? 0 : 1);
    // A sleeping body would not notice a new motor speed.
    if (moving) dBodyEnable(body);
  }
}

void Drivetrain::touch_ground(const OdeWorld& world) {
  if (dBodyIsEnabled(chassis_.body) == 0) return;
  wheels_->touch_ground(world);
  casters_.touch_ground(world);
}

void Drivetrain::follow(hal::Duration step) {
  if (dBodyIsEnabled(chassis_.body) != 0) wheels_->follow(hal::to_seconds(step), angles_);
}

}  // namespace sim::physics
