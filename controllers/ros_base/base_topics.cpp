#include "controllers/ros_base/base_topics.h"

#include <algorithm>
#include <array>

#include "inspectPubSubTypes.h"
#include "ros_nodesPubSubTypes.h"

namespace controllers {
namespace {

template <class Generated>
constexpr auto kMake = &RosParticipant::topic<Generated>;

constexpr auto kTransforms = kMake<tf2_msgs::msg::dds_::TFMessage_PubSubType>;
constexpr auto kText = kMake<std_msgs::msg::dds_::String_PubSubType>;
constexpr auto kDiagnostics = kMake<diagnostic_msgs::msg::dds_::DiagnosticArray_PubSubType>;
constexpr auto kEntities = kMake<rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_PubSubType>;

// Depths: turtlebot3_node and most drivers: 10; tf2_ros/qos.hpp: 100 and, kept for late readers, 1;
// rclcpp::SensorDataQoS: 5; rclcpp::ClockQoS: 1; robot_state_publisher: 1, kept; rmw: 1, kept.
constexpr RosQos kDefault{}, kDynamicTransforms{.depth = 100};
constexpr RosQos kSensorData{.depth = 5, .best_effort = true};
constexpr RosQos kKept{.depth = 1, .transient_local = true};
constexpr RosQos kClock{.depth = 1, .best_effort = true};

const std::array kTopics{
    BaseTopic{"odom", "odom", kDefault, "odometry",
              kMake<nav_msgs::msg::dds_::Odometry_PubSubType>},
    BaseTopic{"tf", "/tf", kDynamicTransforms, "odometry", kTransforms},
    BaseTopic{"tf_static", "/tf_static", kKept, "", kTransforms},
    BaseTopic{"scan", "scan", kSensorData, "scan",
              kMake<sensor_msgs::msg::dds_::LaserScan_PubSubType>},
    BaseTopic{"imu", "imu", kDefault, "imu", kMake<sensor_msgs::msg::dds_::Imu_PubSubType>},
    BaseTopic{"joint_states", "joint_states", kDefault, "odometry",
              kMake<sensor_msgs::msg::dds_::JointState_PubSubType>},
    BaseTopic{"battery_state", "battery_state", kDefault, "battery",
              kMake<sensor_msgs::msg::dds_::BatteryState_PubSubType>},
    BaseTopic{"bumper", "bumper", kDefault, "bumper", kMake<std_msgs::msg::dds_::Bool_PubSubType>},
    BaseTopic{"robot_description", "robot_description", kKept, "", kText},
    BaseTopic{"diagnostics", "/diagnostics", kDefault, "", kDiagnostics},
    BaseTopic{"clock", "/clock", kClock, "", kMake<rosgraph_msgs::msg::dds_::Clock_PubSubType>},
    BaseTopic{"ros_discovery_info", "", kKept, "", kEntities},
};

}  // namespace

std::span<const BaseTopic> base_topics() { return kTopics; }

std::vector<std::string> topic_keys() {
  std::vector<std::string> keys;
  keys.reserve(kTopics.size());
  for (const BaseTopic& topic : kTopics) keys.emplace_back(topic.key);
  return keys;
}

std::vector<std::string> default_topics() {
  std::vector<std::string> keys = topic_keys();
  std::erase(keys, "clock");
  return keys;
}

}  // namespace controllers
