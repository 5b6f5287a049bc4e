#include "hal/node/devices/wheel_drive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "hal/types/math.h"

namespace hal::node::devices {
namespace {

using math::kPi;

constexpr double kRadius = 0.040;    // m, docs/models.md, 5
constexpr double kDistance = 0.132;  // m
constexpr double kTop = 23.56;       // rad/s
constexpr double kRounding = 1e-12;  // a dozen operations on numbers below 100

Wheel wheel_at(double degrees, double distance = kDistance) {
  const double heading = degrees * math::kPi / 180;
  return {{distance * math::cos(heading), distance * math::sin(heading)},
          heading,
          kRadius,
          0.2,
          0.6,
          0.02,
          1.0,
          kTop};
}

std::vector<Wheel> robotino() { return {wheel_at(60), wheel_at(180), wheel_at(300)}; }

TEST(WheelDrive, WheelSpeedsFollowTheDriveDirectionsOfTheRobotinoInterface) {
  // d1 = (-sqrt3/2, 1/2), d2 = (0, -1), d3 = (sqrt3/2, 1/2); (d . v + rb * omega) / rw.
  const double h = std::sqrt(3.0) / 2;
  const Twist2 twist{0.3, -0.2, 0.7};
  const auto speeds = WheelDrive(robotino()).wheel_speeds(twist);
  EXPECT_NEAR(speeds[0], (-h * 0.3 + 0.5 * -0.2 + kDistance * 0.7) / kRadius, kRounding);
  EXPECT_NEAR(speeds[1], (0.2 + kDistance * 0.7) / kRadius, kRounding);
  EXPECT_NEAR(speeds[2], (h * 0.3 + 0.5 * -0.2 + kDistance * 0.7) / kRadius, kRounding);
}

TEST(WheelDrive, InverseIsTheOneOfTheRobotinoInterface) {
  // vx = (m3 - m1)/sqrt3/k, vy = 2/3 (m1 + (m3 - m1)/2 - m2)/k, omega = (vy + m2/k)/rb with
  // k = 1/rw for speeds in rad/s.
  const std::vector<double> m{3, -5, 8};
  const Twist2 twist = WheelDrive(robotino()).body_velocity(m);
  const double vy = 2.0 / 3 * (m[0] + (m[2] - m[0]) / 2 - m[1]) * kRadius;
  EXPECT_NEAR(twist.vx, (m[2] - m[0]) / std::sqrt(3.0) * kRadius, kRounding);
  EXPECT_NEAR(twist.vy, vy, kRounding);
  EXPECT_NEAR(twist.omega, (vy + m[1] * kRadius) / kDistance, kRounding);
}

TEST(WheelDrive, LimitsAreThoseOfTheRobotino) {
  const Twist2 limits = WheelDrive(robotino()).limits();
  EXPECT_NEAR(limits.vx, 1.088, 5e-4);    // three decimals given
  EXPECT_NEAR(limits.vy, 0.942, 5e-4);    // three decimals given
  EXPECT_NEAR(limits.omega, 7.14, 5e-3);  // 0.9424 / 0.132
}

TEST(WheelDrive, PointOfEveryWheelMovesAtItsRimSpeedAlongTheRollingDirection) {
  // A lopsided base: nothing about it is symmetric.
  const std::vector<Wheel> wheels{{{0.2, 0.05}, 0.3, 0.05, 1, 1, 0, 1, 30},
                                  {{-0.1, 0.15}, 2.0, 0.03, 1, 1, 0, 1, 20},
                                  {{-0.07, -0.2}, 4.4, 0.04, 1, 1, 0, 1, 25}};
  const WheelDrive drive(wheels);
  const Twist2 twist{0.4, 0.1, -0.9};
  const auto speeds = drive.wheel_speeds(twist);
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const Vec2 point{twist.vx - twist.omega * wheels[i].position.y,
                     twist.vy + twist.omega * wheels[i].position.x};
    const double rolling = wheels[i].axle_heading + math::kPi / 2;
    const double along = point.x * math::cos(rolling) + point.y * math::sin(rolling);
    EXPECT_NEAR(speeds[i] * wheels[i].radius, along, kRounding);
  }
  EXPECT_EQ(drive.max_wheel_speed(), 20);
}

TEST(WheelDrive, FourWheelsGiveBackTheVelocityThatTheyWereMadeFrom) {
  const WheelDrive drive({wheel_at(45), wheel_at(135), wheel_at(225), wheel_at(315, 0.2)});
  const Twist2 twist{0.3, -0.1, 0.5};
  const Twist2 back = drive.body_velocity(drive.wheel_speeds(twist));
  EXPECT_NEAR(back.vx, twist.vx, kRounding);
  EXPECT_NEAR(back.vy, twist.vy, kRounding);
  EXPECT_NEAR(back.omega, twist.omega, kRounding);
}

TEST(WheelDrive, FourContradictingWheelsAreFittedByLeastSquares) {
  // Equal distances: (+1, -1, +1, -1) is orthogonal to every motion, so its best fit is rest.
  const WheelDrive drive({wheel_at(45), wheel_at(135), wheel_at(225), wheel_at(315)});
  const std::vector<double> speeds{1, -1, 1, -1};
  const Twist2 twist = drive.body_velocity(speeds);
  EXPECT_NEAR(twist.vx, 0, kRounding);
  EXPECT_NEAR(twist.vy, 0, kRounding);
  EXPECT_NEAR(twist.omega, 0, kRounding);
}

TEST(WheelDrive, SaturationScalesAllComponentsByOneFactor) {
  const WheelDrive drive(robotino());
  const Twist2 wanted{1.2, 0.6, 3};
  const auto limited = drive.saturate(wanted);
  EXPECT_TRUE(limited.saturated);
  const double factor = limited.twist.vx / wanted.vx;
  EXPECT_LT(factor, 1);
  EXPECT_NEAR(limited.twist.vy, factor * wanted.vy, kRounding);
  EXPECT_NEAR(limited.twist.omega, factor * wanted.omega, kRounding);
  double fastest = 0;
  for (const double s : drive.wheel_speeds(limited.twist)) fastest = std::max(fastest, std::abs(s));
  EXPECT_NEAR(fastest, kTop, kRounding);
}

TEST(WheelDrive, ReachableVelocitiesAreNotTouched) {
  const Twist2 wanted{0.9, 0.1, 0.2};
  const auto limited = WheelDrive(robotino()).saturate(wanted);
  EXPECT_FALSE(limited.saturated);
  EXPECT_EQ(limited.twist, wanted);
}

TEST(WheelDrive, WheelsThatCannotDriveEveryDirectionAreRefused) {
  EXPECT_THROW(WheelDrive({wheel_at(0), wheel_at(120)}), std::invalid_argument);
  std::vector<Wheel> parallel = robotino();
  for (Wheel& wheel : parallel) wheel.axle_heading = 0.3;
  EXPECT_THROW(WheelDrive{parallel}, std::invalid_argument);
  std::vector<Wheel> flat = robotino();
  flat[1].radius = 0;
  EXPECT_THROW(WheelDrive{flat}, std::invalid_argument);
}

}  // namespace
}  // namespace hal::node::devices
