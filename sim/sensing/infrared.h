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

/// Measurement of one infrared sensor.
struct InfraredMeasurement {
  double volts = 0;   ///< Output of the converter.
  double metres = 0;  ///< By the inverse curve; NaN: nothing within range.
};

/// The infrared sensors of one robot: exact distance, characteristic curve, noise, hold, converter.
///
/// Each sensor measures at its own instants phase + k * hold_period and holds the value in between.
/// A reading at t is the measurement of the last instant u <= t. The robot's pose at u is its pose
/// at t moved back with its velocity; other bodies are taken at t (in hold_period they move 4 cm at
/// 1 m/s with a GP2D12).
class InfraredArray {
 public:
  /// @param agent_name,run_seed  name the random stream "<agent>/infrared" for phases and noise.
  InfraredArray(hal::AgentId agent, std::vector<hal::node::devices::InfraredSensor> sensors,
                std::uint64_t run_seed, std::string_view agent_name);

  /// Updates the readings to `now`. @pre proximity was updated at `now`; `now` never decreases.
  void sample(hal::Time now, const physics::World& world, const Proximity& proximity);

  /// One per sensor, in the order of the robot's file; empty before the first sample().
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

  /// The part of a sensor's view that never changes.
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
  std::vector<Due> due_;  ///< Measurements due in the sample in progress.
};

/// The two channels of one array, which measures once for both: distances and voltages.
/// @param sensors  not empty. @param site  the objects that it refers to outlive the sensors.
std::array<std::unique_ptr<hal::node::devices::Sensor>, 2> simulated(
    const std::vector<hal::node::devices::InfraredSensor>& sensors, const SensorSite& site);

}  // namespace sim::sensing
