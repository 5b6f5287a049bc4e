#pragma once

#include <cstdint>
#include <optional>

#include "controllers/ros_operator/operator_node.h"
#include "hal/api/controller.h"

namespace controllers {

/// Drives robots whose controller is `ros_base`, or any that obey ROS 2's velocity commands: sends
/// one and the same command to all of them, `rate` times a second, over the interface that its
/// agent gives its controller.
///
/// Records `commands`: how many it has sent to each robot, and `odometry`: how many messages of
/// odometry have come from all of them; at each control cycle, whenever there are more.
class RosOperator : public hal::Controller {
 public:
  /// @throws std::invalid_argument  a parameter that no range can judge.
  RosOperator(hal::RealWorldObject& self, const hal::Parameters& parameters);

  void start() override;  ///< @throws std::runtime_error  there is no such interface.
  void timer(hal::TimerId id) override;
  void step() override;
  void stop() override { node_.reset(); }

 private:
  hal::RealWorldObject& self_;
  OperatorNode::Settings settings_;
  const hal::Twist2 twist_;
  const hal::Duration period_;
  std::optional<OperatorNode> node_;
  std::uint64_t sent_ = 0, told_sent_ = 0, told_heard_ = 0;
};

}  // namespace controllers
