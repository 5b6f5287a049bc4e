#include "hal/node/devices/odometry.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "hal/types/math.h"

namespace hal::node::devices {
namespace {

using math::kPi;
using namespace std::chrono_literals;

constexpr double kRounding = 1e-11;  // m, rad: hundreds of operations on numbers below 100

WheelDrive drive() {
  std::vector<Wheel> wheels;
  for (const double degrees : {60.0, 180.0, 300.0}) {
    const double a = degrees * math::kPi / 180;
    wheels.push_back({{0.132 * math::cos(a), 0.132 * math::sin(a)}, a, 0.04, 1, 1, 0, 1, 30});
  }
  return WheelDrive(wheels);
}

/// Drives at constant velocity and lets the odometry look `updates` times.
void run(WheelOdometry& odometry, std::vector<double>& angles, const Twist2& twist, Duration period,
         int updates) {
  const auto speeds = drive().wheel_speeds(twist);
  for (int k = 0; k < updates; ++k) {
    for (std::size_t i = 0; i < angles.size(); ++i) angles[i] += speeds[i] * to_seconds(period);
    odometry.update(angles, period);
  }
}

TEST(WheelOdometry, StraightLineEndsAtSpeedTimesTime) {
  WheelOdometry odometry(drive());
  std::vector<double> angles(3);
  run(odometry, angles, {0.3, -0.2, 0}, 100ms, 50);
  EXPECT_NEAR(odometry.pose().x, 1.5, kRounding);
  EXPECT_NEAR(odometry.pose().y, -1.0, kRounding);
  EXPECT_NEAR(odometry.pose().theta, 0, kRounding);
}

TEST(WheelOdometry, ArcIsExactEvenWhenSampledCoarsely) {
  // Forward at v while turning at w: a circle of radius v/w; x = r sin(wt), y = r (1 - cos(wt)).
  WheelOdometry odometry(drive());
  std::vector<double> angles(3);
  run(odometry, angles, {0.5, 0, 0.8}, 500ms, 4);
  const double r = 0.5 / 0.8;
  EXPECT_NEAR(odometry.pose().x, r * math::sin(1.6), kRounding);
  EXPECT_NEAR(odometry.pose().y, r * (1 - math::cos(1.6)), kRounding);
  EXPECT_NEAR(odometry.pose().theta, 1.6, kRounding);
}

TEST(WheelOdometry, TwistIsTheMeanSinceTheLastUpdate) {
  WheelOdometry odometry(drive());
  std::vector<double> angles(3);
  run(odometry, angles, {0.1, 0.2, -0.3}, 100ms, 1);
  EXPECT_NEAR(odometry.twist().vx, 0.1, kRounding);
  EXPECT_NEAR(odometry.twist().vy, 0.2, kRounding);
  EXPECT_NEAR(odometry.twist().omega, -0.3, kRounding);
}

TEST(WheelOdometry, EncoderStepsBoundTheErrorAndDoNotAddUp) {
  constexpr int kSteps = 512;
  WheelOdometry odometry(drive(), kSteps);
  std::vector<double> angles(3);
  run(odometry, angles, {0.3, 0, 0}, 10ms, 1000);
  // Each wheel is off by less than one step at the start and the end: 2*pi/512 * 0.04 m = 0.5 mm
  // at the rim, at most twice that in x, independent of the 3 m driven.
  EXPECT_NEAR(odometry.pose().x, 3.0, 1e-3);
  EXPECT_GT(std::abs(odometry.pose().x - 3.0), 1e-9);
}

TEST(WheelOdometry, RestartTakesThePresentAnglesAsZero) {
  WheelOdometry odometry(drive());
  std::vector<double> angles{100, -40, 7};
  odometry.restart(angles);
  run(odometry, angles, {0.2, 0, 0}, 1s, 1);
  EXPECT_NEAR(odometry.pose().x, 0.2, kRounding);
  EXPECT_NEAR(odometry.pose().y, 0, kRounding);
}

}  // namespace
}  // namespace hal::node::devices
