#include "hal/files/description/robot_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "hal/files/description/stability.h"
#include "hal/node/devices/wheel_drive.h"
#include "hal/types/math.h"

namespace hal::files::description {
namespace {

using config::Mapping;
using node::devices::BodyBox;
using node::devices::BodyCylinder;
using node::devices::RobotDescription;

/// Depth inside the body that is still tolerated for a flush sensor, because of rounding in the
/// file, m.
constexpr double kFlush = 1e-3;

/// Margin, as a share of the lifting acceleration, that the motors must leave, because bumps and
/// collisions also lift wheels.
constexpr double kSpare = 0.2;

std::string lifts(const Stability& s) {
  return fmt::format(
      "{:.2f} m/s^2 lift wheels off the ground (the centre of mass is {:.3f} m high and {:.3f} m "
      "inside the line between two wheels), and the motors give {:.2f} m/s^2",
      s.lifting, s.centre_of_mass.z, s.inside, s.driving);
}

void check_stability(Mapping& wheels, const RobotDescription& robot, double gravity) {
  const Stability stability = stability_of(robot, gravity > 0 ? gravity : kEarthGravity);
  const Vec3& centre = stability.centre_of_mass;
  if (stability.inside < kFlush) {
    wheels.mistake(
        "joints",
        fmt::format(
            "the centre of mass at ({:.3f}, {:.3f}) m is {} the wheels: the robot would tip over",
            centre.x, centre.y,
            stability.inside < 0 ? "not between" : "on the line between two of"));
  } else if (gravity > 0 && stability.tips_over) {
    wheels.mistake("joints", "the robot would tip over when it reverses: " + lifts(stability));
  } else if (gravity > 0 && stability.driving > (1 - kSpare) * stability.lifting) {
    wheels.warn("joints",
                "the robot is close to tipping over when it reverses: " + lifts(stability));
  }
}

/// Warns if fixed wheels on several axles leave the robot only one motion, in most cases straight
/// ahead.
void check_motions(Mapping& wheels, const node::devices::WheelDrive& drive) {
  if (drive.degrees_of_freedom() > 1) return;
  const Twist2 only = drive.limits();
  wheels.warn("joints",
              fmt::format("the robot can {}: its fixed wheels, which do not slip sideways, have "
                          "axles on more than one line. What a velocity holds beside that is left "
                          "out; if corner wheels are omni, it turns, too",
                          only.omega == 0 ? "only drive straight and never turn"
                                          : "drive one circle only"));
}

void check_wheels(Mapping wheels, const RobotDescription& robot, double gravity) {
  try {
    const node::devices::WheelDrive drive(robot.wheels);
    check_motions(wheels, drive);
    check_stability(wheels, robot, gravity);
  } catch (const std::invalid_argument& error) {
    wheels.mistake("joints", error.what());
  }
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

void check_robot(Mapping& in, const RobotDescription& robot, double gravity) {
  const bool complete =
      robot.wheels.size() >= 3 && !(robot.cylinders.empty() && robot.boxes.empty());
  if (!complete) return;  // reported elsewhere
  check_wheels(in.within("wheels"), robot, gravity);
  check_sensors(in.within("infrared"), robot);
}

}  // namespace hal::files::description
