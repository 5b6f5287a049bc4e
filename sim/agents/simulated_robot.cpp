#include "sim/agents/simulated_robot.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "hal/devices/channels.h"
#include "hal/types/check.h"
#include "sim/sensing/sensors.h"

namespace sim::agents {

using hal::exchange::Action;
using hal::exchange::ActionKind;
using hal::exchange::Event;
using hal::exchange::Reading;

SimulatedRobot::SimulatedRobot(const AgentConfig& config, radio::MacSap& mac,
                               Surroundings surroundings, AgentListener& listener)
    : SimulatedAgent(config, mac, surroundings, listener),
      description_(std::get<hal::devices::RobotDescription>(config.body)),
      drive_(surroundings.world.drive(config.id)),
      odometry_(drive_, description_.encoder_steps),
      infrared_(config.id, description_.infrared, surroundings.config.seed, config.name) {
  const sensing::SensorSite site{
      config.id, config.name, surroundings.config.seed, surroundings.world,
      [&scene = surroundings.scene]() -> const sensing::Proximity& { return scene.proximity(); }};
  const std::vector<hal::Channel> channels = hal::devices::sensor_channels(description_);
  for (std::size_t i = 0; i < channels.size(); ++i)
    sensors_.push_back(
        {channels[i].id, channels[i].name, sensing::make_sensor(description_.sensors[i], site)});
}

void SimulatedRobot::sample(Event& event) {
  SimulatedAgent::sample(event);
  if (wants_channel("odometry")) sample_odometry(event);
  if (wants_channel("infrared") || wants_channel("infrared_volts")) sample_infrared(event);
  for (const Part& part : sensors_) {
    if (!wants_channel(part.name)) continue;
    if (auto values = part.sensor->sample(event.time))
      event.readings.push_back({.channel = part.channel, .values = std::move(*values)});
  }
}

void SimulatedRobot::observe(hal::Time now) {
  if (now > odometry_at_) {
    odometry_.update(surroundings().world.wheel_angles(id()), now - odometry_at_);
  }
  odometry_at_ = now;
  surroundings().observer.on_odometry(now, id(), odometry_.pose(), odometry_.twist());
}

void SimulatedRobot::sample_odometry(Event& event) {
  event.readings.push_back({hal::devices::kOdometry,
                            hal::devices::odometry_values(odometry_.pose(), odometry_.twist())});
}

void SimulatedRobot::sample_infrared(Event& event) {
  Scene& scene = surroundings().scene;
  infrared_.sample(event.time, scene.world(), scene.proximity());
  Reading metres{.channel = hal::devices::kInfrared, .values = {}},
      volts{.channel = hal::devices::kInfraredVolts, .values = {}};
  metres.values.reserve(infrared_.readings().size());
  volts.values.reserve(infrared_.readings().size());
  for (const sensing::InfraredReading& reading : infrared_.readings()) {
    metres.values.push_back(reading.metres);
    volts.values.push_back(reading.volts);
  }
  if (wants_channel("infrared")) event.readings.push_back(std::move(metres));
  if (wants_channel("infrared_volts")) event.readings.push_back(std::move(volts));
}

hal::Result<void> SimulatedRobot::drive(const Action& action) {
  physics::World& world = surroundings().world;
  if (action.kind == ActionKind::kDriveWheels) {
    return world.set_wheel_speeds(id(), action.wheel_speeds);
  }
  const auto driven = world.set_body_velocity(id(), action.twist);
  if (!driven) return hal::fail(driven.error().code, driven.error().message);
  return {};
}

void SimulatedRobot::halt() {
  // Zero is within every limit.
  BARAKA_CHECK(surroundings().world.set_body_velocity(id(), {}).has_value());
}

}  // namespace sim::agents
