#pragma once

#include <cstdint>
#include <optional>

#include "controllers/ros_base/ros_node.h"
#include "hal/api/controller.h"

namespace controllers {

/// Drives as ROS 2 nodes command, over the network interface that the agent gives its controller:
/// it receives velocities on `rt/cmd_vel` and sends odometry on `rt/odom` and `rt/tf` once per
/// control cycle. The wheels stop at the first control cycle in which no command has arrived for
/// `command_timeout`.
///
///   waiting ──command──▶ driving ──silence──▶ stopped
///                           ▲                   │
///                           └──────command──────┘
///
/// Records `commands`, the total received, whenever it increases.
class RosBase : public hal::Controller {
 public:
  /// @throws std::invalid_argument  a parameter that a range cannot check.
  RosBase(hal::Robot& robot, const hal::Parameters& parameters);

  void start() override;  ///< @throws std::runtime_error  the interface does not exist.
  void step() override;
  void stop() override;

 private:
  void obey(const RosNode::Commands& commands);
  void enter(const char* state);

  hal::Robot& robot_;
  RosNode::Settings settings_;
  const hal::Duration command_timeout_;
  std::optional<RosNode> node_;
  hal::Twist2 twist_;  ///< The last command; zero when it is too old.
  std::optional<hal::Time> commanded_;
  std::uint64_t commands_ = 0;
  bool complained_ = false;
  const char* state_ = "";
};

}  // namespace controllers
