#include "hal/node/devices/robot_outline.h"

#include <gtest/gtest.h>

namespace hal::node::devices {
namespace {

TEST(RobotOutline, HasTheShapesThatCollideAndAllWheels) {
  RobotDescription robot;
  robot.model = "two_parts";
  robot.cylinders = {
      {.radius = 0.1, .z_bottom = 0.25, .z_top = 0.5, .centre = {0.01, 0}, .mass = 1}};
  robot.boxes = {{.size = {0.2, 0.1, 0.05}, .centre = {0, 0, 0.1}, .yaw = 0.5, .mass = 1}};
  robot.wheels = {
      {.position = {0, 0.08},
       .axle_heading = -1.5,
       .radius = 0.033,
       .max_torque = 1.4,
       .max_speed = 6.67,
       .type = WheelType::kMecanum,
       .roller_angle = 0.7},
      {.position = {-0.081, 0}, .radius = 0.006, .max_speed = 9, .type = WheelType::kCaster}};
  const RobotBody body = body_of(robot);
  EXPECT_EQ(body.model, "two_parts");
  ASSERT_EQ(body.solids.size(), 2);
  EXPECT_EQ(body.solids[0].shape, Solid::Shape::kCylinder);
  EXPECT_EQ(body.solids[0].size, (Vec3{0.2, 0.2, 0.25}));
  EXPECT_EQ(body.solids[0].centre, (Vec3{0.01, 0, 0.375}));
  EXPECT_EQ(body.solids[1], (Solid{Solid::Shape::kBox, {0.2, 0.1, 0.05}, {0, 0, 0.1}, 0.5}));
  ASSERT_EQ(body.wheels.size(), 2);
  EXPECT_EQ(body.wheels[0], (BodyWheel{true, {0, 0.08}, -1.5, 0.7, 0.033, 6.67, 1.4}));
  EXPECT_EQ(body.wheels[1], (BodyWheel{false, {-0.081, 0}, 0, 0, 0.006, 0, 0}));
}

}  // namespace
}  // namespace hal::node::devices
