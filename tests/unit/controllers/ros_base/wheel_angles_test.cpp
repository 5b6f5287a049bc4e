#include "controllers/ros_base/wheel_angles.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "hal/node/devices/odometry.h"
#include "hal/node/devices/robot_outline.h"
#include "hal/types/random.h"

namespace {

using hal::node::devices::Wheel;
using hal::node::devices::WheelType;

constexpr double kPi = std::numbers::pi;

/// Two fixed wheels and a caster, as of a TurtleBot3.
std::vector<Wheel> differential_drive() {
  return {{.position = {0, 0.08},
           .axle_heading = -kPi / 2,
           .radius = 0.033,
           .max_speed = 6,
           .type = WheelType::kFixed},
          {.position = {0, -0.08},
           .axle_heading = -kPi / 2,
           .radius = 0.033,
           .max_speed = 6,
           .type = WheelType::kFixed},
          {.position = {-0.08, 0}, .radius = 0.006, .type = WheelType::kCaster}};
}

std::vector<Wheel> three_omnis() {
  std::vector<Wheel> wheels;
  for (const double bearing : {kPi / 3, kPi, 5 * kPi / 3}) {
    wheels.push_back({.position = {0.132 * std::cos(bearing), 0.132 * std::sin(bearing)},
                      .axle_heading = bearing,
                      .radius = 0.04,
                      .max_speed = 20});
  }
  return wheels;
}

/// As of a youBot.
std::vector<Wheel> four_mecanums() {
  std::vector<Wheel> wheels;
  for (const auto& [x, y, roller] : {std::array{0.228, 0.158, -kPi / 4},
                                     {0.228, -0.158, kPi / 4},
                                     {-0.228, 0.158, kPi / 4},
                                     {-0.228, -0.158, -kPi / 4}}) {
    wheels.push_back({.position = {x, y},
                      .axle_heading = -kPi / 2,
                      .radius = 0.0475,
                      .max_speed = 16,
                      .type = WheelType::kMecanum,
                      .roller_angle = roller});
  }
  return wheels;
}

hal::RobotBody body_with(const std::vector<Wheel>& wheels) {
  hal::node::devices::RobotDescription robot;
  robot.wheels = wheels;
  return hal::node::devices::body_of(robot);
}

/// Odometry is made of turned wheels for fifty cycles; the angles made of the odometry are those of
/// the wheels, to rounding.
void expect_angles_of_the_wheels(const std::vector<Wheel>& wheels) {
  const hal::node::devices::WheelDrive drive(wheels);
  hal::node::devices::WheelOdometry odometry(drive, 0);
  controllers::WheelAngles angles(body_with(wheels));
  std::vector<double> turned(drive.wheel_count(), 0.0);
  odometry.restart(turned);
  angles.update({odometry.pose(), odometry.twist()});
  hal::RandomStream random(1, "turns");
  for (int cycle = 0; cycle < 50; ++cycle) {
    const hal::Twist2 moved =
        drive.project({0.1 * random.normal(), 0.1 * random.normal(), 0.3 * random.normal()});
    const std::vector<double> turn = drive.wheel_speeds(moved);
    for (std::size_t i = 0; i < turned.size(); ++i) turned[i] += turn[i];
    odometry.update(turned, std::chrono::milliseconds{100});
    angles.update({odometry.pose(), odometry.twist()});
    for (std::size_t i = 0; i < turned.size(); ++i) {
      EXPECT_NEAR(angles.angles()[i], turned[i], 1e-9) << "wheel " << i;
      EXPECT_NEAR(angles.speeds()[i], turn[i] / 0.1, 1e-9) << "wheel " << i;
    }
  }
}

TEST(WheelAngles, AreThoseThatMadeTheOdometryOfTwoFixedWheels) {
  expect_angles_of_the_wheels(differential_drive());
}
TEST(WheelAngles, AreThoseThatMadeTheOdometryOfThreeOmnidirectionalWheels) {
  expect_angles_of_the_wheels(three_omnis());
}
TEST(WheelAngles, AreThoseOfMecanumWheelsThatDoNotContradictEachOther) {
  expect_angles_of_the_wheels(four_mecanums());
}

}  // namespace
