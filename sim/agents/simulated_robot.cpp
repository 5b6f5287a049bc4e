#include "sim/agents/simulated_robot.h"

#include <cstdint>
#include <variant>

#include "hal/devices/channels.h"
#include "hal/types/check.h"

namespace sim::agents {
namespace {

namespace devices = hal::devices;

const hal::devices::RobotDescription& description_of(const AgentConfig& config) {
  return std::get<hal::devices::RobotDescription>(config.body);
}

}  // namespace

SimulatedRobot::SimulatedRobot(const AgentConfig& config, radio::MacSap& mac,
                               Surroundings surroundings, hal::agent::AgentListener& listener)
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
  hal::devices::WheelOdometry then = odometry_;
  then.update(surroundings().world.wheel_angles(id()), now - odometry_at_);
  return then.pose();
}

bool SimulatedRobot::sample(std::size_t channel, hal::Time at, std::vector<double>& values) {
  const std::uint16_t id = core().session().channels[channel].id;
  switch (id) {
    case devices::kOdometry:
      values = devices::odometry_values(odometry_.pose(), odometry_.twist());
      return true;
    case devices::kInfrared:
      for (const sensing::InfraredReading& reading : infrared(at)) values.push_back(reading.metres);
      return true;
    case devices::kInfraredVolts:
      for (const sensing::InfraredReading& reading : infrared(at)) values.push_back(reading.volts);
      return true;
    default:
      return SimulatedMote::sample(channel, at, values);
  }
}

std::span<const sensing::InfraredReading> SimulatedRobot::infrared(hal::Time at) {
  Scene& scene = surroundings().scene;
  infrared_.sample(at, scene.world(), scene.proximity());
  return infrared_.readings();
}

hal::Result<void> SimulatedRobot::drive(const hal::Twist2& body, hal::Time) {
  const auto driven = surroundings().world.set_body_velocity(id(), body);
  if (!driven) return tl::unexpected(driven.error());
  return {};
}

hal::Result<void> SimulatedRobot::drive_wheels(std::span<const double> speeds, hal::Time) {
  return surroundings().world.set_wheel_speeds(id(), speeds);
}

void SimulatedRobot::halt() {
  // Zero is within every limit.
  BARAKA_CHECK(surroundings().world.set_body_velocity(id(), {}).has_value());
}

void SimulatedRobot::cut_motors() {
  BARAKA_CHECK(surroundings().world.set_motors(id(), false).has_value());
}

}  // namespace sim::agents
