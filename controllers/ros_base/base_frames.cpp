#include "controllers/ros_base/base_frames.h"

#include <algorithm>

#include "hal/types/math.h"

namespace controllers {
namespace {

/// Whether there are two driven wheels, one on either side.
bool has_sides(const hal::RobotBody& body) {
  int left = 0, right = 0, driven = 0;
  for (const hal::BodyWheel& wheel : body.wheels) {
    if (!wheel.is_driven) continue;
    ++driven;
    if (wheel.position.y > 0) ++left;
    if (wheel.position.y < 0) ++right;
  }
  return driven == 2 && left == 1 && right == 1;
}

}  // namespace

hal::Vec3 WheelLink::centre() const { return {wheel.position.x, wheel.position.y, wheel.radius}; }

double WheelLink::yaw() const { return wheel.axle_heading + hal::math::kPi / 2; }

std::vector<WheelLink> wheel_links(const hal::RobotBody& body) {
  const bool sides = has_sides(body);
  std::vector<WheelLink> links;
  int driven = 0, casters = 0;
  for (const hal::BodyWheel& wheel : body.wheels) {
    std::string name;
    if (!wheel.is_driven) {
      name = "caster_" + std::to_string(casters++);
    } else if (sides) {
      name = wheel.position.y > 0 ? "wheel_left" : "wheel_right";
    } else {
      name = "wheel_" + std::to_string(driven++);
    }
    links.push_back({std::move(name), wheel});
  }
  return links;
}

std::string_view sensor_link(std::string_view channel) {
  if (channel == "scan") return "base_scan";
  if (channel == "imu") return "imu_link";
  return "";
}

std::vector<FixedLink> fixed_links(std::span<const hal::Channel> channels,
                                   const hal::RobotBody& body) {
  std::vector<FixedLink> links;
  for (const hal::Channel& channel : channels) {
    const std::string link(sensor_link(channel.name));
    if (!link.empty()) links.push_back({link, channel.position, channel.heading});
  }
  for (const WheelLink& wheel : wheel_links(body)) {
    if (!wheel.wheel.is_driven) links.push_back({wheel.link(), wheel.centre()});
  }
  return links;
}

geometry_msgs::msg::dds_::Quaternion_ wheel_rotation(const WheelLink& wheel, double angle) {
  // The product of the rotation about z by the yaw and that about y by the angle.
  const double cz = hal::math::cos(wheel.yaw() / 2), sz = hal::math::sin(wheel.yaw() / 2);
  const double cy = hal::math::cos(angle / 2), sy = hal::math::sin(angle / 2);
  geometry_msgs::msg::dds_::Quaternion_ rotation;
  rotation.x(-sz * sy);
  rotation.y(cz * sy);
  rotation.z(sz * cy);
  rotation.w(cz * cy);
  return rotation;
}

}  // namespace controllers
