#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "hal/node/devices/robot_description.h"
#include "hal/node/devices/sensor.h"
#include "hal/types/agent_id.h"
#include "hal/types/random.h"
#include "hal/types/time.h"
#include "sim/physics/world.h"
#include "sim/sensing/proximity.h"
#include "sim/sensing/sensor_site.h"

namespace sim::sensing {

/// What one infrared sensor shows.
struct InfraredMeasurement {
  double volts = 0;   ///< As the converter saw it.
  double metres = 0;  ///< From the inverse curve; NaN: nothing within reach.
};

/// The infrared sensors of one robot: exact distance, curve, noise, hold, converter.
///
/// Each sensor measures at its own instants phase + k * hold_period and holds the value in between.
/// A reading at t is the measurement of the last instant u <= t; the robot's pose at u is its pose
/// at t moved back with its velocity, other bodies are where they are at t (they move at most
/// hold_period times their speed, 4 cm for a GP2D12 and 1 m/s).
class InfraredArray {
 public:
  /// @param agent_name, run_seed  name the random stream "<agent>/infrared": phases and noise.
  InfraredArray(hal::AgentId agent, std::vector<hal::node::devices::InfraredSensor> sensors,
                std::uint64_t run_seed, std::string_view agent_name);

  /// Brings the readings up to `now`. @pre proximity was updated at `now`; `now` never decreases.
  void sample(hal::Time now, const physics::World& world, const Proximity& proximity);

  /// One per sensor, in the order of the robot's file; empty before the first sample.
  std::span<const InfraredMeasurement> readings() const { return readings_; }

  const std::vector<hal::node::devices::InfraredSensor>& sensors() const { return sensors_; }

 private:
  hal::Time last_instant(std::size_t sensor, hal::Time now) const;
  struct Due {
    std::size_t sensor;
    SectorQuery view;
  };
  void find_due(hal::Time now, const physics::World& world);
  InfraredMeasurement measure(const Due& due, const Proximity& proximity,
                              std::span<const std::size_t> candidates);

  /// What of a sensor's view never changes.
  struct View {
    hal::Vec2 direction;   ///< Unit vector, body frame.
    hal::Vec2 half_angle;  ///< Its cosine and sine.
    double reach;          ///< m
  };
  SectorQuery view_of(std::size_t sensor, const physics::BodyPose& pose,
                      const physics::BodyVelocity& velocity, hal::Duration age) const;

  hal::AgentId agent_;
  std::vector<hal::node::devices::InfraredSensor> sensors_;
  std::vector<View> views_;
  hal::RandomStream random_;
  std::vector<hal::Duration> phases_;
  std::vector<hal::Time> measured_at_;
  std::vector<InfraredMeasurement> readings_;
  std::vector<Due> due_;  ///< Of the sample under way.
};

/// The two channels of one array, which measures once for both: distances and volts.
/// @param sensors  not empty. @param site  what it refers to outlives them.
std::array<std::unique_ptr<hal::node::devices::Sensor>, 2> simulated(
    const std::vector<hal::node::devices::InfraredSensor>& sensors, const SensorSite& site);

}  // namespace sim::sensing
