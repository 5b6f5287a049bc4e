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

/// The sensors of a simulated agent: one part per channel of agent_offer.h, in that order.
class Senses {
 public:
  /// @param range  of the localisation [m]. @param site  the objects that it refers to outlive this
  /// one.
  Senses(const AgentConfig& agent, Scene& scene, double range, const sensing::SensorSite& site);

  /// Call at each control instant.
  void advance(hal::Time at) {
    if (odometry_ != nullptr) odometry_->advance(at);
  }

  /// The values of a channel; those of the last call if there are no newer ones.
  const std::vector<double>& read(std::size_t channel, hal::Time at);

  /// Null if the agent has no wheels.
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
  sensing::Odometry* odometry_ = nullptr;  ///< Points into parts_.
};

}  // namespace sim::agents
