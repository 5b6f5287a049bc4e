#include "programs/models/robot_yaml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "hal/types/math.h"
#include "hal/types/overloaded.h"
#include "programs/models/yaml_text.h"

namespace programs::models {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::string limit_of(const RobotWheel& wheel) {
  return Flow().add("effort", wheel.effort, "N m").add("velocity", wheel.velocity, "rad/s").text();
}

bool are_equal(double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(a); }
bool are_equal(const std::optional<double>& a, const std::optional<double>& b) {
  return a.has_value() == b.has_value() && (!a || are_equal(*a, *b));
}

/// Whether all driven wheels have the same value, but for rounding.
template <class Member>
bool is_common(const std::vector<RobotWheel>& wheels, Member member) {
  const RobotWheel& first = wheels.front();
  return std::ranges::all_of(wheels, [&](const RobotWheel& one) {
    return one.type == "caster" || are_equal(one.*member, first.*member);
  });
}

/// What all driven wheels share is in `wheel`, where a scenario can replace it.
struct Shared {
  explicit Shared(const std::vector<RobotWheel>& wheels)
      : radius(is_common(wheels, &RobotWheel::radius)),
        mass(is_common(wheels, &RobotWheel::mass)),
        mu(is_common(wheels, &RobotWheel::mu)),
        limit(is_common(wheels, &RobotWheel::effort) && is_common(wheels, &RobotWheel::velocity)) {}
  bool radius, mass, mu, limit;
};

bool has_limit(const RobotWheel& wheel) { return wheel.effort || wheel.velocity; }

std::string common_yaml(const RobotWheel& first, const Shared& shared) {
  Flow common;
  if (shared.radius) common.add("radius", first.radius, "m");
  if (shared.mass) common.add("mass", first.mass, "kg");
  if (shared.mu) common.add("mu", first.mu, "1");
  if (shared.limit && has_limit(first)) common.add("limit", limit_of(first));
  return common.is_empty() ? "" : "  wheel: " + common.text() + at_line(first.line);
}

std::string wheel_yaml(const RobotWheel& wheel, const Shared& shared) {
  const bool is_caster = wheel.type == "caster";
  Flow flow;
  flow.add("type", wheel.type).add("position", list(wheel.position, "m"));
  if (!is_caster) flow.add("axis", wheel.axis, "rad");
  flow.add("roller_angle", wheel.roller_angle, "rad");
  if (is_caster || !shared.radius) flow.add("radius", wheel.radius, "m");
  if (is_caster || !shared.mass) flow.add("mass", wheel.mass, "kg");
  if (is_caster || !shared.mu) flow.add("mu", wheel.mu, "1");
  if (!is_caster && !shared.limit && has_limit(wheel)) flow.add("limit", limit_of(wheel));
  return "    - " + flow.text() + at_line(wheel.line);
}

std::string shape_yaml(const RobotShape& shape) {
  const Flow flow = std::visit(
      hal::Overloaded{[](const UprightBox& c) {
                        Flow box;
                        box.add("size", list(c.size, "m")).add("centre", list(c.centre, "m"));
                        box.add("yaw", c.yaw, "rad");
                        return Flow().add("box", box.text());
                      },
                      [](const UprightCylinder& c) {
                        Flow round;
                        round.add("radius", c.radius, "m").add("bottom", c.bottom, "m");
                        round.add("top", c.top, "m").add("centre", list(c.centre, "m"));
                        return Flow().add("cylinder", round.text());
                      }},
      shape.shape);
  return "    - " + flow.text() + at_line(shape.line);
}

std::string link_yaml(const Robot& robot) {
  const Inertial& mass = robot.inertia;
  const Eigen::Matrix3d& t = mass.tensor;
  std::string text = "link:\n";
  if (robot.friction) text += fmt::format("  friction: {}\n", value(*robot.friction, "1"));
  text += "  inertia:" + at_line(mass.line);
  text += fmt::format("    mass: {}{}", value(mass.mass, "kg"), at_line(mass.line));
  text += fmt::format("    centre: {}{}", list(mass.centre, "m"), at_line(mass.line));
  text += fmt::format("    moments: {}{}", list({t(0, 0), t(1, 1), t(2, 2)}, "kg m^2"),
                      at_line(mass.line));
  text += fmt::format("    products: {}{}", list({t(0, 1), t(0, 2), t(1, 2)}, "kg m^2"),
                      at_line(mass.line));
  text += robot.shapes.empty() ? "  collision: []" + at_line(robot.line) : "  collision:\n";
  for (const RobotShape& shape : robot.shapes) text += shape_yaml(shape);
  return text;
}

/// A name that a sensor may have and that no other has.
std::string sensor_name(const std::string& name, const std::string& kind,
                        std::set<std::string>& taken) {
  static const std::set<std::string> names_of_others{
      "localisation", "odometry",  "infrared", "infrared_volts", "odom",   "range",
      "cmd_vel",      "base_link", "base",     "emergency_stop", "battery"};
  std::string own = plain_name(name, kind);
  if (names_of_others.contains(own)) own += "_" + kind;
  return name_of_its_own(own, taken);
}

std::string sensor_yaml(const RobotSensor& one, std::set<std::string>& taken) {
  using Kind = Sensor::Kind;
  const Sensor& sensor = one.sensor;
  const std::string kind = sensor.kind == Kind::kScan  ? "scan"
                           : sensor.kind == Kind::kImu ? "imu"
                                                       : "bumper";
  Flow flow;
  flow.add("kind", kind).add("name", sensor_name(sensor.name, kind, taken));
  double heading = one.heading;
  if (sensor.kind == Kind::kScan) heading += (sensor.min_angle + sensor.max_angle) / 2;
  if (sensor.kind != Kind::kBumper) {
    flow.add("position", list(one.position, "m"));
    flow.add("heading", hal::math::wrap_angle(heading), "rad");
  }
  if (sensor.kind == Kind::kScan) {
    const double field = std::min(sensor.max_angle - sensor.min_angle, 2 * hal::math::kPi);
    flow.add("field", field, "rad").add("rays", std::to_string(sensor.rays));
    flow.add("min_range", sensor.min_range, "m").add("max_range", sensor.max_range, "m");
    flow.add("noise_sigma", sensor.sigma, "m");
    if (sensor.rate > 0) flow.add("period", 1 / sensor.rate, "s");
  } else if (sensor.kind == Kind::kImu) {
    flow.add("gyro_sigma", sensor.sigma, "rad/s");
    flow.add("accelerometer_sigma", sensor.accelerometer_sigma, "m/s^2");
  }
  return "  - " + flow.text() + at_line(sensor.line);
}

}  // namespace

std::string robot_yaml(const Robot& robot, const std::string& file) {
  std::string text = header(file, robot.notes);
  text += fmt::format("version: 1\nmodel: {}{}", quoted(robot.model), at_line(robot.line));
  text += link_yaml(robot);
  const Shared shared(robot.wheels);
  text += "wheels:\n" + common_yaml(robot.wheels.front(), shared);
  text += "  joints:" + at_line(robot.wheels.front().line);
  for (const RobotWheel& wheel : robot.wheels) text += wheel_yaml(wheel, shared);
  if (robot.acceleration) {
    const std::string most = value(*robot.acceleration, "m/s^2");
    text += fmt::format("acceleration: {{linear_up: {}, linear_down: {}}}\n", most, most);
  }
  if (!robot.sensors.empty()) text += "sensors:\n";
  std::set<std::string> taken;
  for (const RobotSensor& one : robot.sensors) text += sensor_yaml(one, taken);
  return text;
}

}  // namespace programs::models
