#include "sim/sensing/infrared.h"

#include <fmt/core.h>

#include <limits>
#include <utility>

#include "hal/types/math.h"

namespace sim::sensing {

using hal::Duration;
using hal::Time;
using hal::devices::InfraredSensor;

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
  const bool first = readings_.empty();
  if (first) {
    readings_.resize(sensors_.size());
    measured_at_.resize(sensors_.size());
  }
  const physics::BodyPose pose = world.pose(agent_);
  const physics::BodyVelocity velocity = world.velocity(agent_);
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const Time instant = last_instant(i, now);
    if (!first && instant == measured_at_[i]) continue;
    measured_at_[i] = instant;
    readings_[i] = measure(i, view_of(i, pose, velocity, now - instant), proximity);
  }
}

Time InfraredArray::last_instant(std::size_t sensor, Time now) const {
  const std::int64_t period = sensors_[sensor].hold_period.count();
  if (period == 0) return now;
  const std::int64_t since = hal::to_ns(now) - phases_[sensor].count();
  return now - Duration{(since % period + period) % period};
}

/// Where a sensor looked `age` ago.
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

InfraredReading InfraredArray::measure(std::size_t index, const SectorQuery& view,
                                       const Proximity& proximity) {
  const InfraredSensor& sensor = sensors_[index];
  const double metres =
      proximity.nearest(view, agent_).value_or(std::numeric_limits<double>::infinity());
  double volts = sensor.curve.volts(metres);
  if (sensor.noise_sigma > 0) volts += sensor.noise_sigma * random_.normal();
  volts = sensor.converter.quantise(volts);
  return {volts, sensor.curve.metres(volts)};
}

}  // namespace sim::sensing
