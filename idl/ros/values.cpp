#include "idl/ros/values.h"

#include <cmath>
#include <limits>

#include "hal/types/math.h"

namespace idl::ros {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

}  // namespace

using geometry_msgs::msg::dds_::Pose_;
using geometry_msgs::msg::dds_::Quaternion_;
using geometry_msgs::msg::dds_::Transform_;
using geometry_msgs::msg::dds_::Twist_;

builtin_interfaces::msg::dds_::Time_ to_ros(hal::Time at) {
  builtin_interfaces::msg::dds_::Time_ stamp;
  stamp.sec(static_cast<std::int32_t>(hal::to_ns(at) / kNsPerSecond));
  stamp.nanosec(static_cast<std::uint32_t>(hal::to_ns(at) % kNsPerSecond));
  return stamp;
}

builtin_interfaces::msg::dds_::Duration_ to_ros(hal::Duration duration) {
  builtin_interfaces::msg::dds_::Duration_ elapsed;
  elapsed.sec(static_cast<std::int32_t>(duration.count() / kNsPerSecond));
  elapsed.nanosec(static_cast<std::uint32_t>(duration.count() % kNsPerSecond));
  return elapsed;
}

Quaternion_ to_quaternion(double theta) {
  Quaternion_ rotation;
  rotation.z(hal::math::sin(theta / 2));
  rotation.w(hal::math::cos(theta / 2));
  return rotation;
}

double heading_of(const Quaternion_& q) {
  return hal::math::atan2(2 * (q.w() * q.z() + q.x() * q.y()),
                          1 - 2 * (q.y() * q.y() + q.z() * q.z()));
}

Transform_ to_transform(const hal::Vec3& translation, double theta) {
  Transform_ transform;
  transform.translation().x(translation.x);
  transform.translation().y(translation.y);
  transform.translation().z(translation.z);
  transform.rotation(to_quaternion(theta));
  return transform;
}

Pose_ to_ros(const hal::Pose2& pose) {
  Pose_ ros;
  ros.position().x(pose.x);
  ros.position().y(pose.y);
  ros.orientation(to_quaternion(pose.theta));
  return ros;
}

Twist_ to_ros(const hal::Twist2& twist) {
  Twist_ ros;
  ros.linear().x(twist.vx);
  ros.linear().y(twist.vy);
  ros.angular().z(twist.omega);
  return ros;
}

float to_ros_distance(double metres) {
  return std::isnan(metres) ? std::numeric_limits<float>::infinity() : static_cast<float>(metres);
}

geometry_msgs::msg::dds_::TransformStamped_ transform_between(const std::string& parent,
                                                              const std::string& child,
                                                              const hal::Vec3& at, double theta) {
  geometry_msgs::msg::dds_::TransformStamped_ stamped;
  stamped.header().frame_id(parent);
  stamped.child_frame_id(child);
  stamped.transform(to_transform(at, theta));
  return stamped;
}

}  // namespace idl::ros
