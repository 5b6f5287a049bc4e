#include <gtest/gtest.h>

#include <cmath>

#include "hal/robot/drivers/odometry_frame.h"
#include "hal/robot/drivers/speed_limits.h"
#include "hal/types/math.h"
#include "tests/unit/hal/robot/drivers/three_wheels.h"

namespace hal::robot::drivers {
namespace {

void expect_near(const Pose2& a, const Pose2& b) {
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
  EXPECT_NEAR(a.theta, b.theta, 1e-12);
}

TEST(SpeedLimits, WithinThemNothingChanges) {
  const auto result =
      limited({0.3, 0.4, -1}, node::devices::WheelDrive(three_wheels()), SpeedLimits{0.5, 1});
  EXPECT_FALSE(result.saturated);
  EXPECT_EQ(result.twist, (Twist2{0.3, 0.4, -1}));
}

TEST(SpeedLimits, OneFactorScalesAllComponents) {
  const auto linear =
      limited({3, 4, 1}, node::devices::WheelDrive(three_wheels()), SpeedLimits{0.5, 1});
  EXPECT_TRUE(linear.saturated);
  EXPECT_NEAR(linear.twist.vx, 0.3, 1e-12);
  EXPECT_NEAR(linear.twist.vy, 0.4, 1e-12);
  EXPECT_NEAR(linear.twist.omega, 0.1, 1e-12);
  const auto angular =
      limited({0.1, 0, -4}, node::devices::WheelDrive(three_wheels()), SpeedLimits{0.5, 1});
  EXPECT_NEAR(angular.twist.vx, 0.025, 1e-12);
  EXPECT_NEAR(angular.twist.omega, -1, 1e-12);
}

TEST(SpeedLimits, WithoutAnyTheWheelsLimitHolds) {
  const node::devices::WheelDrive wheels = node::devices::WheelDrive(three_wheels());
  const auto result = limited({100, 0, 0}, wheels, SpeedLimits{});
  EXPECT_TRUE(result.saturated);
  // The fastest wheels turn at vx sin 60 / r.
  EXPECT_NEAR(result.twist.vx, 23.56 * 0.04 / std::sqrt(0.75), 1e-12);
}

TEST(SpeedLimits, OfZeroHoldTheRobot) {
  const auto result =
      limited({0.1, 0, 1}, node::devices::WheelDrive(three_wheels()), SpeedLimits{0, 1});
  EXPECT_EQ(result.twist, (Twist2{0, 0, 0}));
}

TEST(OdometryFrame, BeginsAtZeroWhereverTheDeviceCountsFrom) {
  OdometryFrame frame;
  expect_near(frame.update({5, -2, math::kPi / 2}, 100), {0, 0, 0});
  // The device saw 1 m along its y, which is where the robot looked: forward.
  expect_near(frame.update({5, -1, math::kPi}, 101), {1, 0, math::kPi / 2});
}

TEST(OdometryFrame, GoesOnWhereItWasWhenTheDeviceBeginsAnew) {
  OdometryFrame frame;
  frame.update({0, 0, 0}, 100);
  expect_near(frame.update({2, 0, math::kPi / 2}, 200), {2, 0, math::kPi / 2});
  expect_near(frame.update({0, 0, 0}, 1), {2, 0, math::kPi / 2});
  expect_near(frame.update({1, 0, 0}, 2), {2, 1, math::kPi / 2});
}

}  // namespace
}  // namespace hal::robot::drivers
