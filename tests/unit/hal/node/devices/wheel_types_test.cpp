#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "hal/node/devices/odometry.h"
#include "hal/node/devices/wheel_drive.h"
#include "hal/types/math.h"
#include "hal/types/random.h"

/// Wheels other than omnidirectional ones, against the kinematics of the textbooks.
namespace hal::node::devices {
namespace {

using math::kPi;

constexpr double kRounding = 1e-12;  // some dozen operations on numbers below 100
constexpr double kRadius = 0.033;    // m
constexpr double kTop = 6.67;        // rad/s

Wheel forward(WheelType type, Vec2 position, double roller_angle = 0) {
  Wheel wheel{.position = position, .axle_heading = -math::kPi / 2, .radius = kRadius};
  wheel.max_speed = kTop;
  wheel.type = type;
  wheel.roller_angle = roller_angle;
  return wheel;
}

/// Two wheels 0.16 m apart on a line across the body, and a caster.
std::vector<Wheel> differential(double axle_ahead = 0) {
  return {forward(WheelType::kFixed, {axle_ahead, 0.08}),
          forward(WheelType::kFixed, {axle_ahead, -0.08}),
          forward(WheelType::kCaster, {-0.081, 0})};
}

void expect_near(const Twist2& a, const Twist2& b, double tolerance = kRounding) {
  EXPECT_NEAR(a.vx, b.vx, tolerance);
  EXPECT_NEAR(a.vy, b.vy, tolerance);
  EXPECT_NEAR(a.omega, b.omega, tolerance);
}

TEST(DifferentialDrive, TurnsItsWheelsAsTheTextbookSays) {
  const WheelDrive drive(differential());
  EXPECT_EQ(drive.wheel_count(), 2u) << "a caster has no motor";
  EXPECT_EQ(drive.degrees_of_freedom(), 2);
  const auto speeds = drive.wheel_speeds({0.2, 0, 0.5});
  EXPECT_NEAR(speeds[0], (0.2 - 0.5 * 0.08) / kRadius, kRounding);
  EXPECT_NEAR(speeds[1], (0.2 + 0.5 * 0.08) / kRadius, kRounding);
  const std::vector<double> turned{3, 5};
  expect_near(drive.body_velocity(turned), {4 * kRadius, 0, 2 * kRadius / 0.16});
}

TEST(DifferentialDrive, LeavesOutWhatItCannotDo) {
  const WheelDrive drive(differential());
  const auto limited = drive.saturate({0.1, 0.2, -0.5});
  expect_near(limited.twist, {0.1, 0, -0.5});
  EXPECT_TRUE(limited.restricted);
  EXPECT_FALSE(limited.saturated);
  EXPECT_FALSE(drive.saturate({0.1, 0, -0.5}).restricted);
  expect_near(drive.saturate({0, 1, 0}).twist, {});
}

TEST(DifferentialDrive, HasNoFastestSidewaysMotion) {
  const Twist2 limits = WheelDrive(differential()).limits();
  EXPECT_NEAR(limits.vx, kTop * kRadius, kRounding);
  EXPECT_NEAR(limits.vy, 0, kRounding);
  EXPECT_NEAR(limits.omega, kTop * kRadius / 0.08, kRounding);
}

TEST(DifferentialDrive, ThatTurnsAboutAPointAheadMovesItsOriginSideways) {
  const WheelDrive drive(differential(0.05));
  // The middle of the axle, (0.05, 0), does not move: vy + 0.05 omega = 0.
  expect_near(drive.saturate({0, 0, 1}).twist, {0, -0.05, 1});
  expect_near(drive.saturate({0.1, 0.3, 1}).twist, {0.1, -0.05, 1});
  EXPECT_NEAR(drive.limits().vy, 0.05 * kTop * kRadius / 0.08, kRounding);
}

TEST(DifferentialDrive, OdometryOfACircleEndsWhereItBegan) {
  const WheelDrive drive(differential());
  WheelOdometry odometry(drive);
  const auto speeds = drive.wheel_speeds({0.2, 0, 0.2});  // a circle of 1 m
  const double around = 2 * math::kPi / 0.2;              // s
  std::array<double, 2> angles{};
  for (int k = 1; k <= 1000; ++k) {
    for (std::size_t i = 0; i < 2; ++i) angles[i] = speeds[i] * around * k / 1000;
    odometry.update(angles, from_seconds(around / 1000));
    const Pose2& pose = odometry.pose();
    if (k == 250) expect_near({pose.x, pose.y, 0}, {1, 1, 0}, 1e-9);  // times are rounded to ns
    if (k == 500) expect_near({pose.x, pose.y, 0}, {0, 2, 0}, 1e-9);
  }
  EXPECT_NEAR(odometry.pose().x, 0, 1e-9);
  EXPECT_NEAR(odometry.pose().y, 0, 1e-9);
}

TEST(MecanumDrive, TurnsItsWheelsAsTheTextbookSays) {
  // H. Taheri, B. Qiao, N. Ghaeminezhad, "Kinematic Model of a Four Mecanum Wheeled Mobile Robot",
  // IJCA, 2015, equation 20: (vx -+ vy -+ (lx + ly) omega) / r.
  constexpr double kLx = 0.228, kLy = 0.158, kSum = kLx + kLy;
  const double quarter = math::kPi / 4;
  const WheelDrive drive({forward(WheelType::kMecanum, {kLx, kLy}, -quarter),
                          forward(WheelType::kMecanum, {kLx, -kLy}, quarter),
                          forward(WheelType::kMecanum, {-kLx, kLy}, quarter),
                          forward(WheelType::kMecanum, {-kLx, -kLy}, -quarter)});
  const Twist2 v{0.05, -0.04, 0.2};
  const auto speeds = drive.wheel_speeds(v);
  EXPECT_NEAR(speeds[0], (v.vx - v.vy - kSum * v.omega) / kRadius, 1e-10);
  EXPECT_NEAR(speeds[1], (v.vx + v.vy + kSum * v.omega) / kRadius, 1e-10);
  EXPECT_NEAR(speeds[2], (v.vx + v.vy - kSum * v.omega) / kRadius, 1e-10);
  EXPECT_NEAR(speeds[3], (v.vx - v.vy + kSum * v.omega) / kRadius, 1e-10);
  EXPECT_EQ(drive.degrees_of_freedom(), 3);
  expect_near(drive.body_velocity(speeds), v);
  EXPECT_EQ(drive.saturate(v).twist, v) << "what is feasible stays as it is, bit by bit";
}

TEST(WheelDrive, ParallelAxlesLeaveStraightDrivingOnly) {
  const WheelDrive drive(
      {forward(WheelType::kFixed, {0.1, 0.1}), forward(WheelType::kFixed, {0.1, -0.1}),
       forward(WheelType::kFixed, {-0.1, 0.1}), forward(WheelType::kFixed, {-0.1, -0.1})});
  EXPECT_EQ(drive.degrees_of_freedom(), 1);
  expect_near(drive.saturate({0.1, 0.1, 0.1}).twist, {0.1, 0, 0});
}

TEST(WheelDrive, WheelsThatCannotMoveTheBodyAreRefused) {
  const Wheel left = forward(WheelType::kFixed, {0, 0.08});
  Wheel across = forward(WheelType::kFixed, {0.1, 0});
  across.axle_heading = 0;
  const Wheel caster = forward(WheelType::kCaster, {-0.081, 0});
  // Two parallel axles and one across leave nothing.
  EXPECT_THROW(WheelDrive({left, forward(WheelType::kFixed, {0.1, 0}), across}),
               std::invalid_argument);
  EXPECT_THROW(WheelDrive({caster, caster, caster}), std::invalid_argument);
  EXPECT_THROW(WheelDrive({forward(WheelType::kFixed, {}), caster}), std::invalid_argument)
      << "one wheel in the middle cannot turn the body";
}

/// Any body on any wheels: what project() gives is feasible, and nothing is left out of that.
TEST(WheelDrive, ProjectionsOfRandomDrivesAreFeasible) {
  RandomStream random(1, "wheels");
  const auto between = [&](double low, double high) {
    return low + (high - low) * random.uniform();
  };
  int drives = 0;
  for (int k = 0; k < 10'000; ++k) {
    std::vector<Wheel> wheels;
    const double axle = between(-math::kPi, math::kPi);
    const Vec2 place{between(-0.2, 0.2), between(-0.2, 0.2)};
    for (const double offset : {between(0.05, 0.2), between(-0.2, -0.05)}) {
      Wheel wheel =
          forward(WheelType::kFixed, place + offset * Vec2{math::cos(axle), math::sin(axle)});
      wheel.axle_heading = axle;
      wheels.push_back(wheel);
    }
    if (k % 3 == 0)
      wheels.push_back(forward(WheelType::kOmni, {between(-0.2, 0.2), between(-0.2, 0.2)}));
    const WheelDrive drive(wheels);
    const Twist2 wanted{between(-1, 1), between(-1, 1), between(-3, 3)};
    const Twist2 v = drive.project(wanted);
    // No point of the axle moves along it.
    const Vec2 at_axle{v.vx - v.omega * place.y, v.vy + v.omega * place.x};
    EXPECT_NEAR(dot(at_axle, {math::cos(axle), math::sin(axle)}), 0, 1e-9);
    expect_near(drive.project(v), v, 1e-9);
    expect_near(drive.body_velocity(drive.wheel_speeds(wanted)), v, 1e-9);
    drives += drive.degrees_of_freedom() == 2 ? 1 : 0;
  }
  EXPECT_EQ(drives, 10'000);
}

}  // namespace
}  // namespace hal::node::devices
