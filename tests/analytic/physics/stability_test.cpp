#include "hal/files/description/stability.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "hal/types/math.h"
#include "sim/physics/world.h"
#include "tests/unit/sim/physics/robertino.h"

/// What hal/files/description says of a robot's stability, against the physics that it drives in.
namespace sim::physics::test {
namespace {

using hal::files::description::Stability;
using hal::files::description::stability_of;
using hal::node::devices::RobotDescription;
using hal::node::devices::WheelLevel;

constexpr AgentId kRobot{1};
constexpr double kGravity = 9.81;  // m/s^2

/// A Robertino with a load of 9 kg that moves its centre of mass towards the line between the
/// wheels at 60 and 300 degrees, 0.066 m ahead of the middle.
struct Load {
  double ahead;         ///< m
  double height;        ///< m
  double braking;       ///< m/s^2; speeds up at 0.6 of it
  double torque;        ///< N m
  double wheel_speed;   ///< rad/s
  const char* outcome;  ///< "stands", "lifts" wheels, or "tips".
};

RobotDescription loaded(const Load& load) {
  RobotDescription robot = robertino();
  robot.boxes.push_back({{0.05, 0.05, 0.05}, {load.ahead, 0, load.height}, 0, 9});
  robot.acceleration = {0.6 * load.braking, load.braking, 1.6, 3.14};
  for (hal::node::devices::Wheel& wheel : robot.wheels) {
    wheel.max_torque = load.torque;
    wheel.max_speed = load.wheel_speed;
  }
  return robot;
}

std::string predicted(const RobotDescription& robot) {
  const Stability stability = stability_of(robot, kGravity);
  if (stability.tips_over) return "tips";
  return stability.driving > stability.lifting ? "lifts" : "stands";
}

/// Full speed to and fro in twelve directions, at both levels of wheels.
std::string driven(RobotDescription robot) {
  constexpr double kLifted = 0.004;  // rad; contacts alone tilt it by a tenth of that
  double tilt = 0;
  for (const WheelLevel level : {WheelLevel::kJointed, WheelLevel::kContact}) {
    robot.wheel_level = level;
    for (int direction = 0; direction < 12; ++direction) {
      const double bearing = direction * hal::math::kPi / 6;
      World world(WorldConfig{});
      world.add_robot(kRobot, robot, {});
      for (int i = 0; i < 1200; ++i) {
        const double speed = i / 150 % 2 == 0 ? 5 : -5;
        EXPECT_TRUE(world.set_body_velocity(
            kRobot, {speed * hal::math::cos(bearing), speed * hal::math::sin(bearing), 0}));
        world.step();
        if (!world.lost_bodies().empty()) return "tips";
        tilt = std::max(tilt, world.pose(kRobot).tilt);
      }
    }
  }
  return tilt > kLifted ? "lifts" : "stands";
}

class LoadedRobot : public testing::TestWithParam<Load> {};

TEST_P(LoadedRobot, DoesWhatItsDescriptionSays) {
  const RobotDescription robot = loaded(GetParam());
  EXPECT_EQ(predicted(robot), GetParam().outcome);
  EXPECT_EQ(driven(robot), GetParam().outcome);
}

// Acceleration, torque, grip and top speed, each once what decides.
INSTANTIATE_TEST_SUITE_P(
    Loads, LoadedRobot,
    testing::Values(Load{0, 0.15, 1.5, 1, 23.56, "stands"},
                    Load{0.06, 0.4, 1.5, 1, 23.56, "stands"},
                    Load{0.09, 0.4, 1.5, 1, 23.56, "tips"}, Load{0.075, 0.4, 1.5, 1, 5, "lifts"},
                    Load{0.105, 0.15, 1.5, 1, 23.56, "tips"}, Load{0, 0.4, 3, 1, 23.56, "stands"},
                    Load{0, 0.4, 3, 5, 23.56, "tips"}, Load{0.015, 0.15, 20, 5, 23.56, "stands"},
                    Load{0.045, 0.15, 20, 5, 23.56, "tips"}, Load{0, 0.4, 20, 5, 5, "lifts"}),
    [](const auto& c) { return fmt::format("Load{}", c.index); });

TEST(Stability, OfTheRobertinoByHand) {
  const Stability stability = stability_of(robertino(), kGravity);
  // 9 kg at 0.115 m, 2 kg at 0.315 m, three wheels of 0.2 kg at 0.04 m.
  const double height = (9 * 0.115 + 2 * 0.315 + 0.6 * 0.04) / 11.6;
  EXPECT_NEAR(stability.centre_of_mass.x, 0, 1e-12);
  EXPECT_NEAR(stability.centre_of_mass.z, height, 1e-12);
  EXPECT_NEAR(stability.inside, 0.066, 1e-12) << "half of 0.132 m";
  EXPECT_NEAR(stability.lifting, kGravity * 0.066 / height, 1e-9);
  EXPECT_EQ(stability.driving, 1.5);
  EXPECT_FALSE(stability.tips_over);
}

TEST(Stability, OnTheMoonASixthOfTheAccelerationLiftsTheWheels) {
  const Stability stability = stability_of(robertino(), kGravity / 6);
  EXPECT_NEAR(stability.lifting, stability_of(robertino(), kGravity).lifting / 6, 1e-9);
  EXPECT_LT(stability.driving, 1.5) << "there is less grip, too";
}

TEST(Stability, CountsOnlyWheelsThatSpanTheAreaBetweenAll) {
  RobotDescription robot = robertino();
  hal::node::devices::Wheel inner = robot.wheels[0];
  inner.position = {0.01, 0.02};
  robot.wheels.push_back(inner);
  EXPECT_NEAR(stability_of(robot, kGravity).inside, 0.066, 1e-3);
  robot.wheels.resize(2);
  robot.wheels.push_back(robot.wheels[0]);
  EXPECT_EQ(stability_of(robot, kGravity).inside, 0) << "all on one line";
}

}  // namespace
}  // namespace sim::physics::test
