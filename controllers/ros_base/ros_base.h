#pragma once

#include <cstdint>
#include <optional>

#include "controllers/ros_base/ros_node.h"
#include "hal/api/controller.h"

namespace controllers {

/// Drives as other nodes of ROS 2 say, over the interface that its agent gives its controller:
/// velocities come on `rt/cmd_vel`, odometry goes out on `rt/odom` and `rt/tf`, once per control
/// cycle. The wheels stop when no command has come for `command_timeout`, which the next control
/// cycle notices.
///
///   waiting ──command──▶ driving ──silence──▶ stopped
///                           ▲                   │
///                           └──────command──────┘
///
/// Records `commands`: how many have come so far, whenever there are more.
class RosBase : public hal::Controller {
 public:
  /// @throws std::invalid_argument  a parameter that no range can judge.
  RosBase(hal::Robot& robot, const hal::Parameters& parameters);

  void start() override;  ///< @throws std::runtime_error  there is no such interface.
  void step() override;
  void stop() override;

 private:
  void obey(const RosNode::Commands& commands);
  void enter(const char* state);

  hal::Robot& robot_;
  RosNode::Settings settings_;
  const hal::Duration command_timeout_;
  std::optional<RosNode> node_;
  hal::Twist2 twist_;  ///< As commanded last; zero when that is too long ago.
  std::optional<hal::Time> commanded_;
  std::uint64_t commands_ = 0;
  bool complained_ = false;
  const char* state_ = "";
};

}  // namespace controllers
