#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "controllers/ros_base/base_frames.h"
#include "controllers/ros_base/base_settings.h"
#include "controllers/ros_base/diagnostics.h"
#include "controllers/ros_base/ros_node.h"
#include "controllers/ros_base/sensor_topic.h"
#include "controllers/ros_base/wheel_angles.h"
#include "hal/api/robot.h"

namespace controllers {

/// What a base tells other nodes: the messages of its topics, from what the robot's HAL knows.
class Publications {
 public:
  /// What the controller itself does.
  struct Activity {
    std::string state;           ///< "driving"
    std::uint64_t commands = 0;  ///< In total.
  };

  /// @param robot, node  outlive it.
  Publications(const hal::Robot& robot, const BaseSettings& settings, RosNode& node);

  /// What does not change: transforms of fixed links, the description of the robot.
  void announce();
  /// What is due at a control cycle.
  void publish(const Activity& activity);

 private:
  using Stamp = RosNode::Stamp;
  using Transform = geometry_msgs::msg::dds_::TransformStamped_;

  std::string frame(const std::string& link) const { return settings_.frame_prefix + link; }
  Transform transform(const std::string& parent, const std::string& child, const hal::Vec3& at,
                      double yaw) const;
  void publish_odometry(const hal::Odometry& odometry, const Stamp& stamp);
  void publish_transforms(const hal::Pose2& pose, const Stamp& stamp);
  void publish_joints(const Stamp& stamp);
  void publish_diagnostics(const Activity& activity, const Stamp& stamp);
  template <class Kind>
  void add_sensor(const char* topic);

  const hal::Robot& robot_;
  const BaseSettings settings_;
  RosNode& node_;
  std::vector<WheelLink> driven_;
  WheelAngles wheels_;
  Diagnostics diagnostics_;
  std::optional<hal::Time> diagnostics_due_;
  std::vector<std::unique_ptr<SensorTopic>> sensors_;
};

}  // namespace controllers
