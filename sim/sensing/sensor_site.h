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

/// Where a simulated sensor is: on which agent, in which world.
struct SensorSite {
  hal::AgentId agent;
  std::string_view agent_name;
  std::uint64_t run_seed = 0;
  const physics::World& world;
  std::function<const Proximity&()> proximity;               ///< As of the last physics step.
  std::function<hal::node::devices::Discharge()> battery{};  ///< As of now, if the agent has one.
};

/// The instants phase + k * period at which a sensor measures; the phase is its own.
class MeasuringInstants {
 public:
  /// @param period  0: at every instant. @param phase  0 .. 1 of the period.
  MeasuringInstants(hal::Duration period, double phase)
      : period_(period.count()),
        phase_(static_cast<std::int64_t>(phase * static_cast<double>(period.count()))) {}

  /// The last one that is not after `now`.
  hal::Time last(hal::Time now) const {
    if (period_ == 0) return now;
    const std::int64_t since = hal::to_ns(now) - phase_;
    return now - hal::Duration{(since % period_ + period_) % period_};
  }

 private:
  std::int64_t period_, phase_;  ///< ns
};

/// Where a body was `age` ago: its pose now, moved back with its velocity now.
hal::Pose2 pose_before(const SensorSite& site, hal::Duration age);

}  // namespace sim::sensing
