#pragma once

#include "hal/types/geometry.h"
#include "hal/types/time.h"
#include "inspect.h"

namespace hal::dds {

// The values of this project to those of ROS 2 messages. Planar values have z, roll, pitch 0.

/// @pre at is not before the start of the run, and within 2^31 s.
builtin_interfaces::msg::dds_::Time_ to_ros(Time at);
/// @pre not negative, and within 2^31 s.
builtin_interfaces::msg::dds_::Duration_ to_ros(Duration duration);

/// Unit quaternion of a turn about z. @param theta  rad
geometry_msgs::msg::dds_::Quaternion_ to_quaternion(double theta);

/// Heading of a unit quaternion: the turn about z that takes the x axis into the plane through z
/// and the turned x axis [rad, (-pi, pi]].
double heading_of(const geometry_msgs::msg::dds_::Quaternion_& rotation);

geometry_msgs::msg::dds_::Transform_ to_transform(const Vec3& translation, double theta);
geometry_msgs::msg::dds_::Pose_ to_ros(const Pose2& pose);
geometry_msgs::msg::dds_::Twist_ to_ros(const Twist2& twist);

}  // namespace hal::dds
