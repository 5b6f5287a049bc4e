#include "controllers/ros_base/urdf.h"

#include <array>
#include <charconv>
#include <vector>

#include "controllers/ros_base/base_frames.h"

namespace controllers {
namespace {

/// The shortest text that reads as the same number.
std::string number(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

std::string escaped(const std::string& text) {
  std::string xml;
  for (const char c : text) {
    if (c == '&') {
      xml += "&amp;";
    } else if (c == '<') {
      xml += "&lt;";
    } else if (c == '"') {
      xml += "&quot;";
    } else {
      xml += c;
    }
  }
  return xml;
}

std::string three(const hal::Vec3& v) {
  return number(v.x) + " " + number(v.y) + " " + number(v.z);
}

std::string origin(const hal::Vec3& at, double yaw) {
  return "<origin xyz=\"" + three(at) + "\" rpy=\"0 0 " + number(yaw) + "\"/>";
}

std::string geometry_of(const hal::Solid& solid) {
  switch (solid.shape) {
    case hal::Solid::Shape::kCylinder:
      return "<cylinder radius=\"" + number(solid.size.x / 2) + "\" length=\"" +
             number(solid.size.z) + "\"/>";
    case hal::Solid::Shape::kSphere:
      return "<sphere radius=\"" + number(solid.size.x / 2) + "\"/>";
    default:
      return "<box size=\"" + three(solid.size) + "\"/>";
  }
}

/// As what is seen and as what collides.
std::string shape(const hal::Solid& solid) {
  const std::string inside =
      origin(solid.centre, solid.yaw) + "<geometry>" + geometry_of(solid) + "</geometry>";
  return "    <visual>" + inside + "</visual>\n    <collision>" + inside + "</collision>\n";
}

std::string link(const std::string& name, const std::vector<hal::Solid>& solids) {
  if (solids.empty()) return "  <link name=\"" + name + "\"/>\n";
  std::string xml = "  <link name=\"" + name + "\">\n";
  for (const hal::Solid& solid : solids) xml += shape(solid);
  return xml + "  </link>\n";
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& inside) {
  return "  <joint name=\"" + name + "\" type=\"" + type + "\">\n    <parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>\n    " + inside + "\n  </joint>\n";
}

std::string wheel_parts(const WheelLink& wheel) {
  if (!wheel.wheel.is_driven) {
    const double diameter = 2 * wheel.wheel.radius;
    return link(wheel.link(), {{.shape = hal::Solid::Shape::kSphere,
                                .size = {diameter, diameter, diameter},
                                .centre = {}}}) +
           joint(wheel.joint(), "fixed", kBaseLink, wheel.link(), origin(wheel.centre(), 0));
  }
  const std::string turning =
      origin(wheel.centre(), wheel.yaw()) + "<axis xyz=\"0 1 0\"/><limit effort=\"" +
      number(wheel.wheel.max_torque) + "\" velocity=\"" + number(wheel.wheel.max_speed) + "\"/>";
  return link(wheel.link(), {}) +
         joint(wheel.joint(), "continuous", kBaseLink, wheel.link(), turning);
}

}  // namespace

std::string urdf_of(const hal::RobotBody& body, std::span<const hal::Channel> channels,
                    const std::string& root) {
  std::string xml = "<?xml version=\"1.0\"?>\n<robot name=\"" + escaped(body.model) + "\">\n";
  if (root != kBaseLink) {
    const std::string name = escaped(root);
    xml += link(name, {}) + joint("base_joint", "fixed", name, kBaseLink, origin({}, 0));
  }
  xml += link(kBaseLink, body.solids);
  for (const FixedLink& sensor : fixed_links(channels, {})) {
    xml += link(sensor.link, {}) + joint(sensor.link + "_joint", "fixed", kBaseLink, sensor.link,
                                         origin(sensor.at, sensor.yaw));
  }
  for (const WheelLink& wheel : wheel_links(body)) xml += wheel_parts(wheel);
  return xml + "</robot>\n";
}

}  // namespace controllers
