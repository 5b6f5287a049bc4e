#include <gtest/gtest.h>

#include <cmath>

#include "sim/physics/world.h"
#include "tests/unit/sim/physics/robertino.h"

/// What motors draw from a battery: work and heat.
namespace sim::physics::test {
namespace {

using hal::Twist2;
using hal::node::devices::RobotDescription;
using hal::node::devices::WheelLevel;

constexpr AgentId kRobot{1};
constexpr double kMass = 11.6;  // kg
constexpr double kSpeed = 0.9;  // m/s

/// A robot whose battery has to know, in a world that measures nothing else.
RobotDescription fed(WheelLevel level, double stall_power) {
  RobotDescription robot = robertino(level);
  for (auto& wheel : robot.wheels) wheel.stall_power = stall_power;
  robot.sensors.emplace_back(hal::node::devices::Battery{});
  return robot;
}

Energy after(World& world, int steps) {
  for (int i = 0; i < steps; ++i) world.step();
  return world.energy(kRobot);
}

class MotorInput : public testing::TestWithParam<WheelLevel> {};
INSTANTIATE_TEST_SUITE_P(Levels, MotorInput, kLevels, level_name);

TEST_P(MotorInput, OfLosslessMotorsIsTheGainInEnergyAndTheFrictionOfTheRollers) {
  World world(WorldConfig{});
  world.add_robot(kRobot, fed(GetParam(), 0), {});
  const double before = world.energy(kRobot).mechanical();
  ASSERT_TRUE(world.set_body_velocity(kRobot, {kSpeed, 0, 0}));
  const Energy energy = after(world, 300);
  const double gain = energy.mechanical() - before;
  EXPECT_NEAR(gain, 0.5 * kMass * kSpeed * kSpeed, 0.02 * gain);
  EXPECT_NEAR(energy.motor_input, gain + energy.friction_loss, 0.01 * energy.motor_input);
}

TEST_P(MotorInput, IsNotGivenBackWhileBraking) {
  World world(WorldConfig{});
  world.add_robot(kRobot, fed(GetParam(), 0), {});
  ASSERT_TRUE(world.set_body_velocity(kRobot, {kSpeed, 0, 0}));
  const Energy fast = after(world, 300);
  ASSERT_TRUE(world.set_body_velocity(kRobot, {}));
  const Energy braked = after(world, 100);
  EXPECT_LT(braked.motor_work, fast.motor_work - 0.5 * fast.kinetic);
  EXPECT_NEAR(braked.motor_input, fast.motor_input, 0.01 * fast.motor_input);
}

TEST_P(MotorInput, IsMeasuredForABatteryOnly) {
  World world(WorldConfig{});
  world.add_robot(kRobot, robertino(GetParam()), {});
  ASSERT_TRUE(world.set_body_velocity(kRobot, {kSpeed, 0, 0}));
  EXPECT_EQ(after(world, 100).motor_input, 0);
}

// Ahead, the wheel behind idles and the two in front share the force F = m a, each with F / (2 sin
// 60 deg) along its grip. On smooth rollers nothing is needed to hold the speed.
TEST(MotorInputOfASpeedingRobot, IsKineticEnergyAndTheHeatOfTheWindings) {
  constexpr double kStall = 10;  // W at 1 N m
  RobotDescription smooth = fed(WheelLevel::kContact, kStall);
  for (auto& wheel : smooth.wheels) wheel.mu2 = 0;
  World world(WorldConfig{});
  world.add_robot(kRobot, smooth, {});
  ASSERT_TRUE(world.set_body_velocity(kRobot, {kSpeed, 0, 0}));
  const Energy energy = after(world, 300);
  const double acceleration = smooth.acceleration.linear_up;
  const double torque = kMass * acceleration / std::sqrt(3.0) * smooth.wheels[0].radius;  // N m
  const double heat = 2 * kStall * torque * torque * kSpeed / acceleration;               // J
  const double kinetic = 0.5 * kMass * kSpeed * kSpeed;
  EXPECT_GT(heat, 1);
  // Contacts give a little way: the surface runs ahead of the body by up to 1 %, and so does the
  // work.
  EXPECT_NEAR(energy.motor_input, kinetic + heat, 0.02 * (kinetic + heat));
}

}  // namespace
}  // namespace sim::physics::test
