#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "controllers/ros_base/base_settings.h"
#include "controllers/ros_base/publications.h"
#include "controllers/ros_base/ros_node.h"
#include "hal/api/controller.h"

namespace controllers {

/// A robot's base as ROS 2 knows it, over the network interface that the agent gives its
/// controller: it drives by the velocities on `cmd_vel` and tells what it and its sensors measure
/// (docs/ros2.md). The wheels stop at the first control cycle in which no command has arrived for
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

  /// @throws std::runtime_error  the interface does not exist.
  /// @throws std::invalid_argument  the agent's name cannot be part of a namespace.
  void start() override;
  void step() override;
  void stop() override;

 private:
  /// Without the topics whose device the robot does not have.
  BaseSettings offered() const;
  void obey(const RosNode::Commands& commands);
  void enter(const char* state);

  hal::Robot& robot_;
  const BaseSettings settings_;
  const hal::Duration command_timeout_;
  std::optional<RosNode> node_;
  std::optional<Publications> publications_;
  hal::Twist2 twist_;  ///< The last command; zero when it is too old.
  std::optional<hal::Time> commanded_;
  std::uint64_t commands_ = 0;
  bool complained_ = false;
  const char* state_ = "";
};

}  // namespace controllers
