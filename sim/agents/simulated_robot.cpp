#include "sim/agents/simulated_robot.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/types/check.h"

namespace sim::agents {
namespace {

double fastest_of(std::span<const double> speeds) {
  double fastest = 0;
  for (const double speed : speeds) fastest = std::max(fastest, std::abs(speed));
  return fastest;
}

}  // namespace

/// Factor for a command whose fastest wheel turns at `fastest` [rad/s].
double SimulatedRobot::share_of(double fastest) const {
  return fastest > wheel_limit_ ? wheel_limit_ / fastest : 1;
}

hal::Result<void> SimulatedRobot::drive(const hal::Twist2& body, hal::Time) {
  physics::World& world = surroundings().world;
  auto driven = world.set_body_velocity(id(), body);
  if (!driven) return tl::unexpected(driven.error());
  if (std::isinf(wheel_limit_)) return {};
  const hal::Twist2& able = driven->twist;
  std::vector<double> speeds(world.drive(id()).wheel_count());
  world.drive(id()).wheel_speeds(able, speeds);
  const double share = share_of(fastest_of(speeds));
  if (share == 1) return {};
  driven = world.set_body_velocity(id(), {share * able.vx, share * able.vy, share * able.omega});
  return {};
}

hal::Result<void> SimulatedRobot::drive_wheels(std::span<const double> speeds, hal::Time) {
  const double share = share_of(fastest_of(speeds));
  if (share == 1) return surroundings().world.set_wheel_speeds(id(), speeds);
  std::vector<double> slower(speeds.begin(), speeds.end());
  for (double& speed : slower) speed *= share;
  return surroundings().world.set_wheel_speeds(id(), slower);
}

void SimulatedRobot::halt() {
  // Zero is within all limits.
  BARAKA_CHECK(surroundings().world.set_body_velocity(id(), {}).has_value());
}

void SimulatedRobot::feed_motors() {
  const double input = surroundings().world.motor_input(id());
  const double joules = input - std::exchange(motor_input_, input);
  // The input may not be finite if the body's state has diverged.
  const double watts = joules / hal::to_seconds(surroundings().config.world.step);
  supply()->set_motors(std::isfinite(watts) ? watts : 0);
}

void SimulatedRobot::set_motors(bool on) {
  BARAKA_CHECK(surroundings().world.set_motors(id(), on).has_value());
}

}  // namespace sim::agents
