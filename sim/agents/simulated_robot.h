#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal/devices/odometry.h"
#include "hal/devices/robot_description.h"
#include "hal/devices/sensor.h"
#include "sim/agents/simulated_agent.h"
#include "sim/sensing/infrared.h"

namespace sim::agents {

/// A robot: an agent with wheels, odometry and infrared sensors. Its body is in the world already.
class SimulatedRobot final : public SimulatedAgent {
 public:
  SimulatedRobot(const AgentConfig& config, radio::MacSap& mac, Surroundings surroundings,
                 AgentListener& listener);

  bool has_wheels() const override { return true; }

 private:
  void observe(hal::Time now) override;
  void sample(hal::exchange::Event& event) override;
  hal::Result<void> drive(const hal::exchange::Action& action) override;
  void halt() override;

  void sample_odometry(hal::exchange::Event& event);
  void sample_infrared(hal::exchange::Event& event);

  const hal::devices::RobotDescription& description_;
  const hal::devices::WheelDrive& drive_;
  hal::devices::WheelOdometry odometry_;
  hal::Time odometry_at_{};
  sensing::InfraredArray infrared_;
  struct Part {
    std::uint16_t channel = 0;
    std::string name;  ///< Of the channel.
    std::unique_ptr<hal::devices::Sensor> sensor;
  };
  std::vector<Part> sensors_;
};

}  // namespace sim::agents
