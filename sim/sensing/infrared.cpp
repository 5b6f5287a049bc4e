#include "sim/sensing/infrared.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "hal/node/devices/channels.h"
#include "hal/types/math.h"

namespace sim::sensing {

using hal::Duration;
using hal::Time;
using hal::node::devices::infrared_channels;
using hal::node::devices::InfraredSensor;

namespace {

/// Smallest region that contains two regions.
Region around(const Region& a, const Region& b) {
  return {
      {std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
      {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}

/// One value per sensor of an array.
class InfraredChannel final : public hal::node::devices::Sensor {
 public:
  /// @param channel  index in infrared_channels(). @param value  member of a measurement.
  InfraredChannel(std::shared_ptr<InfraredArray> array, SensorSite site, std::size_t channel,
                  double InfraredMeasurement::*value)
      : array_(std::move(array)), site_(std::move(site)), channel_(channel), value_(value) {}

  hal::Channel describe() const override {
    const std::vector<InfraredSensor>& sensors = array_->sensors();
    return infrared_channels(sensors, sensors.front().hold_period).at(channel_);
  }

  std::optional<std::vector<double>> sample(Time at) override {
    array_->sample(at, site_.world, site_.proximity());
    std::vector<double> values;
    for (const InfraredMeasurement& reading : array_->readings()) values.push_back(reading.*value_);
    return values;
  }

 private:
  std::shared_ptr<InfraredArray> array_;
  SensorSite site_;
  std::size_t channel_;
  double InfraredMeasurement::*value_;
};

}  // namespace

InfraredArray::InfraredArray(hal::AgentId agent, std::vector<InfraredSensor> sensors,
                             std::uint64_t run_seed, std::string_view agent_name)
    : agent_(agent),
      sensors_(std::move(sensors)),
      random_(run_seed, fmt::format("{}/infrared", agent_name)) {
  for (const InfraredSensor& sensor : sensors_) {
    const double period = static_cast<double>(sensor.hold_period.count());
    phases_.emplace_back(static_cast<std::int64_t>(random_.uniform() * period));
    views_.push_back({unit(sensor.heading), unit(sensor.half_angle), sensor.curve.reach()});
  }
}

void InfraredArray::sample(Time now, const physics::World& world, const Proximity& proximity) {
  find_due(now, world);
  if (due_.empty()) return;
  Region region = due_.front().view.bounds();
  for (const Due& due : due_) region = around(region, due.view.bounds());
  const std::span<const std::size_t> candidates = proximity.within(region);
  for (const Due& due : due_) readings_[due.sensor] = measure(due, proximity, candidates);
}

/// Lists the sensors with a new measurement since the last sample, and their views at that time.
void InfraredArray::find_due(Time now, const physics::World& world) {
  const bool first = readings_.empty();
  readings_.resize(sensors_.size());
  measured_at_.resize(sensors_.size());
  due_.clear();
  const physics::BodyPose pose = world.pose(agent_);
  const physics::BodyVelocity velocity = world.velocity(agent_);
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const Time instant = last_instant(i, now);
    if (!first && instant == measured_at_[i]) continue;
    measured_at_[i] = instant;
    due_.push_back({i, view_of(i, pose, velocity, now - instant)});
  }
}

Time InfraredArray::last_instant(std::size_t sensor, Time now) const {
  const std::int64_t period = sensors_[sensor].hold_period.count();
  if (period == 0) return now;
  const std::int64_t since = hal::to_ns(now) - phases_[sensor].count();
  return now - Duration{(since % period + period) % period};
}

/// View of a sensor `age` ago.
SectorQuery InfraredArray::view_of(std::size_t sensor, const physics::BodyPose& pose,
                                   const physics::BodyVelocity& velocity, Duration age) const {
  const double seconds = hal::to_seconds(age);
  const hal::Vec2 ahead = unit(pose.heading - seconds * velocity.angular.z);
  const hal::Vec3 body = pose.position - seconds * velocity.linear;
  const hal::Vec3& mount = sensors_[sensor].position;
  const hal::Vec2 offset = turned({mount.x, mount.y}, ahead);
  const View& view = views_[sensor];
  return {{body.x + offset.x, body.y + offset.y, body.z + mount.z},
          turned(view.direction, ahead),
          view.half_angle,
          view.reach};
}

InfraredMeasurement InfraredArray::measure(const Due& due, const Proximity& proximity,
                                           std::span<const std::size_t> candidates) {
  const InfraredSensor& sensor = sensors_[due.sensor];
  const double metres = proximity.nearest(due.view, agent_, candidates)
                            .value_or(std::numeric_limits<double>::infinity());
  double volts = sensor.curve.volts(metres);
  if (sensor.noise_sigma > 0) volts += sensor.noise_sigma * random_.normal();
  volts = sensor.converter.quantise(volts);
  return {volts, sensor.curve.metres(volts)};
}

std::array<std::unique_ptr<hal::node::devices::Sensor>, 2> simulated(
    const std::vector<InfraredSensor>& sensors, const SensorSite& site) {
  const auto array =
      std::make_shared<InfraredArray>(site.agent, sensors, site.run_seed, site.agent_name);
  return {std::make_unique<InfraredChannel>(array, site, 0, &InfraredMeasurement::metres),
          std::make_unique<InfraredChannel>(array, site, 1, &InfraredMeasurement::volts)};
}

}  // namespace sim::sensing
