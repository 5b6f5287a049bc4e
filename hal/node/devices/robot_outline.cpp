#include "hal/node/devices/robot_outline.h"

namespace hal::node::devices {
namespace {

Solid solid_of(const BodyCylinder& part) {
  return {.shape = Solid::Shape::kCylinder,
          .size = {2 * part.radius, 2 * part.radius, part.z_top - part.z_bottom},
          .centre = {part.centre.x, part.centre.y, (part.z_bottom + part.z_top) / 2}};
}

Solid solid_of(const BodyBox& part) {
  return {.size = part.size, .centre = part.centre, .yaw = part.yaw};
}

BodyWheel wheel_of(const Wheel& wheel) {
  return {.is_driven = wheel.is_driven(),
          .position = wheel.position,
          .axle_heading = wheel.axle_heading,
          .roller_angle = wheel.roller_angle,
          .radius = wheel.radius,
          .max_speed = wheel.is_driven() ? wheel.max_speed : 0,
          .max_torque = wheel.is_driven() ? wheel.max_torque : 0};
}

}  // namespace

RobotBody body_of(const RobotDescription& robot) {
  RobotBody body{robot.model, {}, {}};
  for (const BodyCylinder& part : robot.cylinders) body.solids.push_back(solid_of(part));
  for (const BodyBox& part : robot.boxes) body.solids.push_back(solid_of(part));
  for (const Wheel& wheel : robot.wheels) body.wheels.push_back(wheel_of(wheel));
  return body;
}

}  // namespace hal::node::devices
