#pragma once

#include <cstdint>
#include <string>

#include "hal/types/geometry.h"
#include "hal/types/time.h"
#include "inspect.h"

namespace idl::ros {

// Conversion of this project's values to ROS 2 messages. In planar values, z, roll and pitch are 0.

/// @pre `at` is within 2^31 s after the start of the run, not before it.
builtin_interfaces::msg::dds_::Time_ to_ros(hal::Time at);
/// @pre not negative, and less than 2^31 s.
builtin_interfaces::msg::dds_::Duration_ to_ros(hal::Duration duration);

/// Unit quaternion of a turn about z. @param theta  rad
geometry_msgs::msg::dds_::Quaternion_ to_quaternion(double theta);

/// Heading of a unit quaternion [rad, (-pi, pi]]: the rotation about z that takes the x axis into
/// the plane through z and the rotated x axis.
double heading_of(const geometry_msgs::msg::dds_::Quaternion_& rotation);

geometry_msgs::msg::dds_::Transform_ to_transform(const hal::Vec3& translation, double theta);
geometry_msgs::msg::dds_::Pose_ to_ros(const hal::Pose2& pose);
geometry_msgs::msg::dds_::Twist_ to_ros(const hal::Twist2& twist);

inline constexpr std::uint8_t kInfrared = 1;  ///< Range: radiation_type

/// A distance [m] by ROS REP 117: +infinity for nothing within range (NaN in this project),
/// -infinity for too near.
float to_ros_distance(double metres);

/// Transformation of frame `child` in frame `parent`. @param theta  rad, about z
geometry_msgs::msg::dds_::TransformStamped_ transform_between(const std::string& parent,
                                                              const std::string& child,
                                                              const hal::Vec3& at, double theta);

}  // namespace idl::ros
