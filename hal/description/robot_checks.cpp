#include "hal/description/robot_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "hal/devices/wheel_drive.h"
#include "hal/types/math.h"

namespace hal::description {
namespace {

using config::Mapping;
using devices::BodyBox;
using devices::BodyCylinder;
using devices::RobotDescription;

/// A sensor flush with the surface may be this deep inside by rounding of the file's numbers, m.
constexpr double kFlush = 1e-3;

Vec2 centre_of_mass(const RobotDescription& robot) {
  double mass = 0;
  Vec2 moment;
  const auto add = [&](double m, Vec2 at) {
    mass += m;
    moment = moment + m * at;
  };
  for (const auto& cylinder : robot.cylinders) add(cylinder.mass, cylinder.centre);
  for (const auto& box : robot.boxes) add(box.mass, {box.centre.x, box.centre.y});
  for (const auto& wheel : robot.wheels) add(wheel.mass, wheel.position);
  return (1 / mass) * moment;
}

/// Whether the wheels stand on all sides of a point: seen from it, no gap between neighbours
/// reaches half a turn.
bool carry(const RobotDescription& robot, Vec2 point) {
  std::vector<double> bearings;
  for (const auto& wheel : robot.wheels) {
    const Vec2 to = wheel.position - point;
    bearings.push_back(math::atan2(to.y, to.x));
  }
  std::sort(bearings.begin(), bearings.end());
  double gap = bearings.front() + 2 * math::kPi - bearings.back();
  for (std::size_t i = 1; i < bearings.size(); ++i)
    gap = std::max(gap, bearings[i] - bearings[i - 1]);
  return gap < math::kPi;
}

void check_wheels(Mapping wheels, const RobotDescription& robot) {
  try {
    const devices::WheelDrive drive(robot.wheels);
  } catch (const std::invalid_argument& error) {
    wheels.mistake("joints", error.what());
  }
  const Vec2 centre = centre_of_mass(robot);
  if (carry(robot, centre)) return;
  wheels.mistake("joints", fmt::format("the centre of mass at ({:.3f}, {:.3f}) m is not between "
                                       "the wheels: the robot would tip over",
                                       centre.x, centre.y));
}

bool contains(const BodyCylinder& part, const Vec3& point) {
  const Vec2 to{point.x - part.centre.x, point.y - part.centre.y};
  const double inner = part.radius - kFlush;
  return inner > 0 && dot(to, to) < inner * inner && point.z > part.z_bottom + kFlush &&
         point.z < part.z_top - kFlush;
}

bool contains(const BodyBox& part, const Vec3& point) {
  const Vec3 to = point - part.centre;
  const double c = math::cos(part.yaw);
  const double s = math::sin(part.yaw);
  return std::abs(c * to.x + s * to.y) < part.size.x / 2 - kFlush &&
         std::abs(c * to.y - s * to.x) < part.size.y / 2 - kFlush &&
         std::abs(to.z) < part.size.z / 2 - kFlush;
}

bool is_inside(const RobotDescription& robot, const Vec3& point) {
  const auto holds = [&](const auto& part) { return contains(part, point); };
  return std::any_of(robot.cylinders.begin(), robot.cylinders.end(), holds) ||
         std::any_of(robot.boxes.begin(), robot.boxes.end(), holds);
}

void check_sensors(Mapping infrared, const RobotDescription& robot) {
  std::vector<Mapping> mounts = infrared.items("mounts");
  for (std::size_t i = 0; i < std::min(mounts.size(), robot.infrared.size()); ++i) {
    if (is_inside(robot, robot.infrared[i].position))
      mounts[i].mistake("", "the sensor is inside the body, where it sees nothing");
  }
}

}  // namespace

void check_robot(Mapping& in, const RobotDescription& robot) {
  const bool complete =
      robot.wheels.size() >= 3 && !(robot.cylinders.empty() && robot.boxes.empty());
  if (!complete) return;  // that was noted
  check_wheels(in.within("wheels"), robot);
  check_sensors(in.within("infrared"), robot);
}

}  // namespace hal::description
