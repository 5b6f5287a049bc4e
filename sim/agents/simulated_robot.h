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

  /// Call after each physics step if the robot has a battery: until the next step, the motors draw
  /// from the battery the power that they used in this one.
  void feed_motors();

  /// Pose by odometry if it were read now, in the frame of the start pose.
  hal::Pose2 reckoned(hal::Time now) const { return senses().odometry()->reckoned(now); }
  /// Limits the speed of every wheel: faster commands are scaled down, keeping the direction.
  /// @param limit  [rad/s], > 0
  void limit_wheels(double limit) { wheel_limit_ = limit; }

 private:
  double share_of(double fastest) const;
  void set_motors(bool on) override;

  double motor_input_ = 0;  ///< Energy used by the motors up to the last physics step [J].
  double wheel_limit_ = std::numeric_limits<double>::infinity();  ///< rad/s
};

}  // namespace sim::agents
