#pragma once

#include <limits>
#include <span>

#include "sim/agents/simulated_mote.h"

namespace sim::agents {

/// A robot: a mote with wheels.
class SimulatedRobot final : public SimulatedMote, public hal::node::agent::Drive {
 public:
  SimulatedRobot(const AgentConfig& config, radio::MacSap& mac, Surroundings surroundings,
                 hal::node::agent::AgentListener& listener)
      : SimulatedMote(config, mac, surroundings, listener, this) {}

  hal::Result<void> drive(const hal::Twist2& body, hal::Time as_of) override;
  hal::Result<void> drive_wheels(std::span<const double> speeds, hal::Time as_of) override;
  void halt() override;

  /// After each step of the physics, if it has a battery: until the next one the motors take from
  /// it what they took in this one.
  void feed_motors();

  /// Where it would be by its odometry if that were read now, in the frame at the start.
  hal::Pose2 reckoned(hal::Time now) const { return senses().odometry()->reckoned(now); }
  /// No wheel turns faster than this any more: commands beyond it are scaled down, direction kept.
  /// @param limit  rad/s, > 0
  void limit_wheels(double limit) { wheel_limit_ = limit; }

 private:
  double share_of(double fastest) const;
  void set_motors(bool on) override;

  double motor_input_ = 0;  ///< J until the last step of the physics.
  double wheel_limit_ = std::numeric_limits<double>::infinity();  ///< rad/s
};

}  // namespace sim::agents
