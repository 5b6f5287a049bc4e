#include <gtest/gtest.h>

#include <cmath>

#include "hal/types/math.h"
#include "sim/physics/world.h"
#include "tests/unit/sim/physics/robertino.h"

/// A robot on a slope of 5 degrees (gravity tilted), motors off.
namespace sim::physics::test {
namespace {

using hal::math::kPi;
using hal::node::devices::RobotDescription;
using hal::node::devices::WheelLevel;

constexpr AgentId kRobot{1};
constexpr double kSlope = 5 * hal::math::kPi / 180;  // rad
constexpr double kMass = 11.6;                       // kg: 9 + 2 + three wheels of 0.2
constexpr int kSteps = 100;

double gravity_along() { return 9.81 * hal::math::sin(kSlope); }
double gravity_across() { return 9.81 * hal::math::cos(kSlope); }

/// Downhill is world x.
WorldConfig slope() {
  WorldConfig config;
  config.down = {hal::math::sin(kSlope), 0, -hal::math::cos(kSlope)};
  return config;
}

/// kg; coasting also turns the wheels. A wheel of inertia I = 2/5 m r^2 whose rolling direction
/// makes the angle b with the motion adds I (cos b / r)^2; over three wheels at 120 degrees the
/// cosines' squares sum to 3/2 in any direction.
double moving_mass(WheelLevel level) {
  const double turning = 1.5 * 0.4 * 0.2;
  return level == WheelLevel::kJointed ? kMass + turning : kMass;
}

struct Coasted {
  BodyPose pose;
  BodyVelocity velocity;
  double odometer = 0;  ///< rad, of the wheel that sees most of the motion
};

/// One second downhill, `heading` being the robot's own x axis.
Coasted coast(const RobotDescription& description, double heading) {
  World world(slope());
  world.add_robot(kRobot, description, {0, 0, heading});
  EXPECT_TRUE(world.set_motors(kRobot, false));
  for (int i = 0; i < kSteps; ++i) world.step();
  return {world.pose(kRobot), world.velocity(kRobot), world.wheel_angles(kRobot)[0]};
}

class Coasting : public testing::TestWithParam<WheelLevel> {};
INSTANTIATE_TEST_SUITE_P(Levels, Coasting, kLevels, level_name);

// Semi-implicit Euler under a constant force: v = a t, x = a t (t + h) / 2.
TEST_P(Coasting, FrictionlessRollersGiveTheClosedFormWithTheWheelsInertia) {
  RobotDescription smooth = robertino(GetParam());
  for (auto& wheel : smooth.wheels) wheel.mu2 = 0;
  const double a = gravity_along() * kMass / moving_mass(GetParam());
  for (const double heading : {0.0, hal::math::kPi / 2}) {  // along the robot's x, across it
    const Coasted coasted = coast(smooth, heading);
    EXPECT_NEAR(coasted.velocity.linear.x, a, 5e-4 * a) << heading;  // m/s after 1 s
    EXPECT_NEAR(coasted.pose.position.x, a * 1.01 / 2, 5e-4 * a) << heading;
    EXPECT_NEAR(coasted.pose.position.y, 0, 1e-3) << heading;  // m
    EXPECT_LT(std::abs(hal::math::wrap_angle(coasted.pose.heading - heading)), 1e-3);
  }
}

// Sliding along its axle, wheel i brakes with mu2 N_i |cos(axle_i, motion)|. For N_i equal the
// cosines' mean is (1/2 + 1 + 1/2) / 3 along x and 2 sin(60 deg) / 3 across. The braking forces
// shift load between the wheels by about 2 % of it: 0.3 % of the acceleration.
TEST_P(Coasting, RollersBrakeWithTheirFriction) {
  const double root3 = std::sqrt(3.0);
  for (const auto& [heading, share] : {std::pair{0.0, 2.0 / 3}, {hal::math::kPi / 2, root3 / 3}}) {
    const double force = gravity_along() - 0.02 * share * gravity_across();
    const double a = force * kMass / moving_mass(GetParam());
    EXPECT_NEAR(coast(robertino(GetParam()), heading).velocity.linear.x, a, 5e-3 * a) << heading;
  }
}

TEST_P(Coasting, WheelsCountThemselvesRolling) {
  RobotDescription smooth = robertino(GetParam());
  for (auto& wheel : smooth.wheels) wheel.mu2 = 0;
  const Coasted coasted = coast(smooth, 0);
  // The wheel at 60 degrees drives towards 150 degrees: it sees cos(150 deg) of the way.
  const double angle = -std::sqrt(3.0) / 2 * coasted.pose.position.x / 0.04;
  EXPECT_NEAR(coasted.odometer, angle, 0.01 * std::abs(angle));  // rad
}

TEST_P(Coasting, PoweredMotorsHoldTheRobot) {
  World world(slope());
  world.add_robot(kRobot, robertino(GetParam()), {});
  for (int i = 0; i < kSteps; ++i) world.step();
  EXPECT_NEAR(world.pose(kRobot).position.x, 0, 1e-3);  // m
  ASSERT_TRUE(world.set_motors(kRobot, false));
  for (int i = 0; i < kSteps; ++i) world.step();
  EXPECT_GT(world.pose(kRobot).position.x, 0.3);
}

TEST_P(Coasting, SwitchingOnAgainBrakes) {
  World world(slope());
  world.add_robot(kRobot, robertino(GetParam()), {});
  ASSERT_TRUE(world.set_motors(kRobot, false));
  for (int i = 0; i < 50; ++i) world.step();
  ASSERT_TRUE(world.set_motors(kRobot, true));
  for (int i = 0; i < 200; ++i) world.step();
  EXPECT_NEAR(world.velocity(kRobot).linear.x, 0, 1e-3);  // m/s
}

TEST(CoastingMote, HasNoMotors) {
  World world(slope());
  world.add_mote(kRobot, {}, {});
  EXPECT_EQ(world.set_motors(kRobot, false).error().code, hal::Errc::kNotAvailable);
}

}  // namespace
}  // namespace sim::physics::test
