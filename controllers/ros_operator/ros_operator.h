#pragma once

#include <cstdint>
#include <optional>

#include "controllers/ros_operator/operator_node.h"
#include "hal/api/controller.h"

namespace controllers {

/// Drives robots whose controller is `ros_base`, or others that accept velocity commands of ROS 2:
/// sends the same command to all of them, `rate` times a second, over the network interface that
/// the agent gives its controller.
///
/// Records, at control cycles in which they have increased, the totals `commands`, sent to each
/// robot, and `odometry`, messages received from all robots.
class RosOperator : public hal::Controller {
 public:
  /// @throws std::invalid_argument  a parameter that a range cannot check.
  RosOperator(hal::RealWorldObject& self, const hal::Parameters& parameters);

  void start() override;  ///< @throws std::runtime_error  the interface does not exist.
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
