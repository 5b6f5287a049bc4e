#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hal/api/robot.h"
#include "inspect.h"

namespace controllers {

// Links of a robot and how they are joined, with the names of TurtleBot3 (turtlebot3_description)
// in the frames of REP 105: base_footprint -> base_link -> base_scan, imu_link, wheel_left_link, …
// A robot's file knows one frame of the body, whose origin is on the ground: base_footprint and
// base_link are equal. x is forward, y left, z up (REP 103).

inline constexpr const char* kBaseLink = "base_link";

/// A wheel or caster and its link. The link's z axis points up when the wheel has not turned, its y
/// axis is the axle, about which a positive speed turns it.
struct WheelLink {
  std::string name;  ///< "wheel_left": two wheels left and right. "wheel_0", "caster_0": others.
  hal::BodyWheel wheel;

  std::string joint() const { return name + "_joint"; }
  std::string link() const { return name + "_link"; }
  hal::Vec3 centre() const;
  double yaw() const;  ///< rad, of the link's x axis in base_link.
};

/// In the order of the body.
std::vector<WheelLink> wheel_links(const hal::RobotBody& body);

/// Link of the sensor with this channel; empty: it has none.
std::string_view sensor_link(std::string_view channel);

/// A link that does not move in base_link.
struct FixedLink {
  std::string link;
  hal::Vec3 at;    ///< m
  double yaw = 0;  ///< rad
};

/// The sensors among these channels, then the casters.
std::vector<FixedLink> fixed_links(std::span<const hal::Channel> channels,
                                   const hal::RobotBody& body);

/// Rotation of a wheel's link in base_link. @param angle  rad, by which the wheel has turned.
geometry_msgs::msg::dds_::Quaternion_ wheel_rotation(const WheelLink& wheel, double angle);

}  // namespace controllers
