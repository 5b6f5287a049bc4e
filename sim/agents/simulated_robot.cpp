#include "sim/agents/simulated_robot.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <variant>

#include "hal/node/devices/channels.h"
#include "hal/types/check.h"

namespace sim::agents {
namespace {

namespace devices = hal::node::devices;

const hal::node::devices::RobotDescription& description_of(const AgentConfig& config) {
  return std::get<hal::node::devices::RobotDescription>(config.body);
}

double fastest_of(std::span<const double> speeds) {
  double fastest = 0;
  for (const double speed : speeds) fastest = std::max(fastest, std::abs(speed));
  return fastest;
}

}  // namespace

SimulatedRobot::SimulatedRobot(const AgentConfig& config, radio::MacSap& mac,
                               Surroundings surroundings, hal::node::agent::AgentListener& listener)
    : SimulatedMote(config, mac, surroundings, listener, this),
      odometry_(surroundings.world.drive(config.id), description_of(config).encoder_steps),
      infrared_(config.id, description_of(config).infrared, surroundings.config.seed, config.name) {
}

void SimulatedRobot::advance(hal::Time at) {
  if (at > odometry_at_) {
    odometry_.update(surroundings().world.wheel_angles(id()), at - odometry_at_);
  }
  odometry_at_ = at;
}

hal::Pose2 SimulatedRobot::reckoned(hal::Time now) const {
  if (now <= odometry_at_) return odometry_.pose();
  hal::node::devices::WheelOdometry then = odometry_;
  then.update(surroundings().world.wheel_angles(id()), now - odometry_at_);
  return then.pose();
}

bool SimulatedRobot::sample(std::size_t channel, hal::Time at, std::vector<double>& values) {
  if (!is_fed(core().session().channels[channel])) return false;
  const std::uint16_t id = core().session().channels[channel].id;
  switch (id) {
    case devices::kOdometry:
      values = devices::odometry_values(odometry_.pose(), odometry_.twist());
      return true;
    case devices::kInfrared:
      for (const sensing::InfraredMeasurement& reading : infrared(at))
        values.push_back(reading.metres);
      return true;
    case devices::kInfraredVolts:
      for (const sensing::InfraredMeasurement& reading : infrared(at))
        values.push_back(reading.volts);
      return true;
    default:
      return SimulatedMote::sample(channel, at, values);
  }
}

std::span<const sensing::InfraredMeasurement> SimulatedRobot::infrared(hal::Time at) {
  Scene& scene = surroundings().scene;
  infrared_.sample(at, scene.world(), scene.proximity());
  return infrared_.readings();
}

/// Of a command whose fastest wheel turns with this. rad/s
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
  // Zero is within every limit.
  BARAKA_CHECK(surroundings().world.set_body_velocity(id(), {}).has_value());
}

void SimulatedRobot::feed_motors() {
  const double input = surroundings().world.motor_input(id());
  const double joules = input - std::exchange(motor_input_, input);
  // Of a body that blew up nothing can be told.
  const double watts = joules / hal::to_seconds(surroundings().config.world.step);
  supply()->set_motors(std::isfinite(watts) ? watts : 0);
}

void SimulatedRobot::set_motors(bool on) {
  BARAKA_CHECK(surroundings().world.set_motors(id(), on).has_value());
}

}  // namespace sim::agents
