#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "hal/node/devices/sensor.h"
#include "sim/agents/simulation_config.h"
#include "sim/agents/surroundings.h"
#include "sim/sensing/odometry.h"
#include "sim/sensing/sensor_site.h"

namespace sim::agents {

/// What a simulated agent senses: one part per channel of agent_offer.h, in its order.
class Senses {
 public:
  /// @param range  m, of the localisation. @param site  what it refers to outlives this.
  Senses(const AgentConfig& agent, Scene& scene, double range, const sensing::SensorSite& site);

  /// A control instant has come.
  void advance(hal::Time at) {
    if (odometry_ != nullptr) odometry_->advance(at);
  }

  /// The values of a channel; those of the last time if there are no newer ones.
  const std::vector<double>& read(std::size_t channel, hal::Time at);

  /// Null: the agent has no wheels.
  const sensing::Odometry* odometry() const { return odometry_; }

 private:
  struct Part {
    std::unique_ptr<hal::node::devices::Sensor> sensor;
    std::vector<double> held;  ///< Its last values.
  };

  void add(std::unique_ptr<hal::node::devices::Sensor> sensor);
  void add_robot(const hal::node::devices::RobotDescription& robot,
                 const sensing::SensorSite& site);

  std::vector<Part> parts_;
  sensing::Odometry* odometry_ = nullptr;  ///< Of parts_.
};

}  // namespace sim::agents
