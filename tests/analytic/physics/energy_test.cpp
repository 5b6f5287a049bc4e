#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hal/types/math.h"
#include "sim/physics/world.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::physics::test {
namespace {

using hal::Twist2;
using hal::math::kPi;
using hal::node::devices::RobotDescription;
using hal::node::devices::WheelLevel;

constexpr AgentId kRobot{1};
constexpr double kMass = 11.6;  // kg

WorldConfig measuring() {
  WorldConfig config;
  config.measure_energy = true;
  return config;
}

class EnergyOf : public testing::TestWithParam<WheelLevel> {};
INSTANTIATE_TEST_SUITE_P(Levels, EnergyOf, kLevels, level_name);

TEST_P(EnergyOf, MotorWorkIsGainInEnergyAndLosses) {
  for (const Twist2& command : {Twist2{0.9, 0, 0}, {0, 0.9, 0}, {0.4, -0.4, -2}}) {
    World world(measuring());
    world.add_robot(kRobot, robertino(GetParam()), {});
    const double before = world.energy(kRobot).mechanical();
    ASSERT_TRUE(world.set_body_velocity(kRobot, command));
    for (int i = 1; i <= 300; ++i) {
      world.step();
      if (i % 100 != 0) continue;
      const Energy energy = world.energy(kRobot);
      const double gain = energy.mechanical() - before;
      EXPECT_GT(energy.motor_work, 0.01);  // J
      EXPECT_NEAR(energy.motor_work, gain + energy.friction_loss, 0.01 * energy.motor_work) << i;
    }
  }
}

/// J that a spinning robot's motors put in within 3 s and neither motion nor friction shows.
double missing_in_a_spin(WheelLevel level, hal::Duration step) {
  WorldConfig config = measuring();
  config.step = step;
  World world(config);
  world.add_robot(kRobot, robertino(level), {});
  const double before = world.energy(kRobot).mechanical();
  EXPECT_TRUE(world.set_body_velocity(kRobot, {0, 0, 2}));
  while (world.now() < hal::Time{std::chrono::seconds(3)}) world.step();
  const Energy energy = world.energy(kRobot);
  return energy.motor_work - (energy.mechanical() - before) - energy.friction_loss;
}

// In a spin nothing is moved and little is rubbed away, so that the integrator's own loss shows:
// hinges force wheels on their circle that a step let go straight on. It is of first order.
TEST(EnergyOfASpin, MissesWhatTheIntegratorLoses) {
  using namespace std::chrono_literals;
  const double coarse = missing_in_a_spin(WheelLevel::kJointed, 10ms);
  const double fine = missing_in_a_spin(WheelLevel::kJointed, 5ms);
  EXPECT_GT(coarse, 0);
  EXPECT_NEAR(fine / coarse, 0.5, 0.05);
  EXPECT_LT(fine, 0.015);  // J, of 0.36 J in motion
}

TEST_P(EnergyOf, WorkOnSmoothRollersIsTheKineticEnergyOfTheClosedForm) {
  RobotDescription smooth = robertino(GetParam());
  for (auto& wheel : smooth.wheels) wheel.mu2 = 0;
  World world(measuring());
  world.add_robot(kRobot, smooth, {});
  ASSERT_TRUE(world.set_body_velocity(kRobot, {0, 0.9, 0}));
  for (int i = 0; i < 300; ++i) world.step();
  // Turning wheels add 3/2 of 2/5 of a wheel's mass (see coasting_test).
  const double mass = GetParam() == WheelLevel::kJointed ? kMass + 0.12 : kMass;
  const double kinetic = 0.5 * mass * 0.9 * 0.9;  // J
  EXPECT_NEAR(world.energy(kRobot).kinetic, kinetic, 0.002 * kinetic);
  EXPECT_NEAR(world.energy(kRobot).motor_work, kinetic, 0.01 * kinetic);
}

TEST_P(EnergyOf, CruisingCostsTheFrictionOfTheRollers) {
  World world(measuring());
  world.add_robot(kRobot, robertino(GetParam()), {});
  ASSERT_TRUE(world.set_body_velocity(kRobot, {0, 0.9, 0}));
  for (int i = 0; i < 300; ++i) world.step();
  const Energy before = world.energy(kRobot);
  for (int i = 0; i < 100; ++i) world.step();
  const Energy after = world.energy(kRobot);
  // W: mu2 m g v (sin 60 deg + 0 + sin 60 deg) / 3; it shifts load by about 1 %.
  const double power = 0.02 * kMass * 9.81 * 0.9 * std::sqrt(3.0) / 3;
  EXPECT_NEAR(after.friction_loss - before.friction_loss, power, 0.02 * power);
  EXPECT_NEAR(after.motor_work - before.motor_work, power, 0.03 * power);
}

TEST_P(EnergyOf, CoastingNeverGainsEnergy) {
  for (const Twist2& command : {Twist2{0.4, -0.4, -2}, {0, 0, 2}, {0.9, 0, 0}}) {
    World world(WorldConfig{});
    world.add_robot(kRobot, robertino(GetParam()), {});
    ASSERT_TRUE(world.set_body_velocity(kRobot, command));
    for (int i = 0; i < 300; ++i) world.step();
    ASSERT_TRUE(world.set_motors(kRobot, false));
    double last = world.energy(kRobot).mechanical();
    const double kinetic = world.energy(kRobot).kinetic;
    for (int i = 0; i < 300 && !world.asleep(kRobot); ++i) {
      world.step();
      const double now = world.energy(kRobot).mechanical();
      EXPECT_LE(now, last + 1e-6 * kinetic) << i;  // J: rounding of contacts that settle
      last = now;
    }
    EXPECT_LT(world.energy(kRobot).kinetic, kinetic);
  }
}

AgentId member(int i) { return AgentId{static_cast<std::uint16_t>(i + 1)}; }

double total_energy(const World& world, int robots) {
  double sum = 0;
  for (int i = 0; i < robots; ++i) sum += world.energy(member(i)).mechanical();
  return sum;
}

// Robots that rush into one heap and lose their motors there: what the solvers of a jam add is
// bounded.
TEST_P(EnergyOf, JamsGainAtMostAPercent) {
  constexpr int kRobots = 10;
  World world(WorldConfig{});
  for (int i = 0; i < kRobots; ++i) {
    const double angle = 2 * hal::math::kPi * i / kRobots;
    world.add_robot(
        member(i), robertino(GetParam()),
        {1.5 * hal::math::cos(angle), 1.5 * hal::math::sin(angle), angle + hal::math::kPi});
    ASSERT_TRUE(world.set_body_velocity(member(i), {0.9, 0, 0}));
  }
  for (int i = 0; i < 125; ++i) world.step();
  ASSERT_EQ(world.jammed_steps(), 0U);  // they have not met yet
  double kinetic = 0;
  for (int i = 0; i < kRobots; ++i) {
    ASSERT_TRUE(world.set_motors(member(i), false));
    kinetic += world.energy(member(i)).kinetic;
  }
  double lowest = total_energy(world, kRobots);
  for (int i = 0; i < 300; ++i) {
    world.step();
    const double now = total_energy(world, kRobots);
    EXPECT_LE(now, lowest + 0.01 * kinetic) << i;  // J
    lowest = std::min(lowest, now);
  }
  EXPECT_GT(world.jammed_steps(), 0U);
}

}  // namespace
}  // namespace sim::physics::test
