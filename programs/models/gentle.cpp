#include "programs/models/gentle.h"

#include <algorithm>
#include <stdexcept>

#include "hal/files/description/stability.h"

namespace programs::models {
namespace {

constexpr double kSpare = 0.25;
constexpr double kLeast = 0.05;  ///< m/s^2; a robot that cannot even do so stands badly.

hal::Vec3 as_vec3(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

hal::node::devices::WheelType type_of(const std::string& type) {
  using enum hal::node::devices::WheelType;
  if (type == "caster") return kCaster;
  if (type == "omni") return kOmni;
  return type == "mecanum" ? kMecanum : kFixed;
}

/// Motors whose limits the file lacks are strong.
constexpr double kStrong = 100;  ///< N m
constexpr double kFast = 30;     ///< rad/s

hal::node::devices::RobotDescription description_of(const Robot& robot) {
  const Eigen::Matrix3d& t = robot.inertia.tensor;
  hal::node::devices::RobotDescription made;
  made.inertia = {robot.inertia.mass,
                  as_vec3(robot.inertia.centre),
                  {t(0, 0), t(1, 1), t(2, 2)},
                  {t(0, 1), t(0, 2), t(1, 2)}};
  for (const RobotWheel& wheel : robot.wheels) {
    hal::node::devices::Wheel one;
    one.position = {wheel.position.x(), wheel.position.y()};
    one.axle_heading = wheel.axis;
    one.radius = wheel.radius;
    one.mass = wheel.mass;
    one.mu = wheel.mu.value_or(wheel.type == "caster" ? 0.02 : 0.6);
    one.mu2 = wheel.type == "fixed" ? one.mu : 0.02;
    one.max_torque = wheel.effort.value_or(kStrong);
    one.max_speed = wheel.velocity.value_or(kFast);
    one.type = type_of(wheel.type);
    one.roller_angle = wheel.roller_angle.value_or(0);
    made.wheels.push_back(one);
  }
  return made;
}

}  // namespace

std::optional<double> gentle_acceleration(const Robot& robot) {
  if (robot.wheels.size() < 3) return std::nullopt;
  auto made = description_of(robot);
  std::optional<double> gentle;
  try {
    // Once for each edge at most: the weakest one becomes strong enough.
    for (std::size_t i = 0; i < made.wheels.size(); ++i) {
      const auto weakest =
          hal::files::description::stability_of(made, hal::files::description::kEarthGravity);
      const double most = (1 - kSpare) * weakest.lifting;
      if (weakest.inside <= 0 || most < kLeast || weakest.driving <= most) break;
      gentle = most;
      made.acceleration.linear_up = std::min(made.acceleration.linear_up, most);
      made.acceleration.linear_down = most;
    }
  } catch (const std::invalid_argument&) {
    return std::nullopt;  // wheels that cannot drive, which the reader of the YAML refuses
  }
  return gentle;
}

}  // namespace programs::models
