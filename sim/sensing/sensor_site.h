#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "hal/node/devices/battery.h"
#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "sim/physics/world.h"
#include "sim/sensing/proximity.h"

namespace sim::sensing {

/// What a simulated sensor is attached to: its agent and world.
struct SensorSite {
  hal::AgentId agent;
  std::string_view agent_name;
  std::uint64_t run_seed = 0;
  const physics::World& world;
  std::function<const Proximity&()> proximity;  ///< As of the last physics step.
  /// As of now; empty if the agent has no battery.
  std::function<hal::node::devices::Discharge()> battery{};
};

/// The instants phase + k * period at which a sensor measures; each sensor has its own phase.
class MeasuringInstants {
 public:
  /// @param period  0: measures at every instant. @param phase  as a share of the period, 0 .. 1.
  MeasuringInstants(hal::Duration period, double phase)
      : period_(period.count()),
        phase_(static_cast<std::int64_t>(phase * static_cast<double>(period.count()))) {}

  /// The last measuring instant that is not after `now`.
  hal::Time last(hal::Time now) const {
    if (period_ == 0) return now;
    const std::int64_t since = hal::to_ns(now) - phase_;
    return now - hal::Duration{(since % period_ + period_) % period_};
  }

 private:
  std::int64_t period_, phase_;  ///< ns
};

/// Pose of a body `age` ago: its pose now, moved back with its velocity now.
hal::Pose2 pose_before(const SensorSite& site, hal::Duration age);

}  // namespace sim::sensing
