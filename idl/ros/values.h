#pragma once

#include <cstdint>
#include <string>

#include "hal/types/geometry.h"
#include "hal/types/time.h"
#include "inspect.h"

namespace idl::ros {

// The values of this project to those of ROS 2 messages. Planar values have z, roll, pitch 0.

/// @pre at is not before the start of the run, and within 2^31 s.
builtin_interfaces::msg::dds_::Time_ to_ros(hal::Time at);
/// @pre not negative, and within 2^31 s.
builtin_interfaces::msg::dds_::Duration_ to_ros(hal::Duration duration);

/// Unit quaternion of a turn about z. @param theta  rad
geometry_msgs::msg::dds_::Quaternion_ to_quaternion(double theta);

/// Heading of a unit quaternion: the turn about z that takes the x axis into the plane through z
/// and the turned x axis [rad, (-pi, pi]].
double heading_of(const geometry_msgs::msg::dds_::Quaternion_& rotation);

geometry_msgs::msg::dds_::Transform_ to_transform(const hal::Vec3& translation, double theta);
geometry_msgs::msg::dds_::Pose_ to_ros(const hal::Pose2& pose);
geometry_msgs::msg::dds_::Twist_ to_ros(const hal::Twist2& twist);

inline constexpr std::uint8_t kInfrared = 1;  ///< Range: radiation_type

/// A distance [m] as ROS REP 117 has it: +infinity for nothing within reach, which is NaN here,
/// -infinity for too near.
float to_ros_distance(double metres);

/// Where frame `child` is in frame `parent`. @param theta  rad, about z
geometry_msgs::msg::dds_::TransformStamped_ transform_between(const std::string& parent,
                                                              const std::string& child,
                                                              const hal::Vec3& at, double theta);

}  // namespace idl::ros
