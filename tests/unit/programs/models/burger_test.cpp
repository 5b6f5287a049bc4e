// A TurtleBot3 Burger in URDF drives as config/robots/turtlebot3_burger.yaml.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "sim/physics/world.h"
#include "tests/unit/programs/models/loaded.h"

namespace programs::models::test {
namespace {

constexpr hal::AgentId kRobot{1};

std::string burger() {
  return "urdf: " + robots() +
         "turtlebot3_burger.urdf\n"
         "drive: {left: wheel_left_joint, right: wheel_right_joint, casters: caster_back_link}\n"
         "wheels: {wheel: {limit: {effort: 1.4 N m, velocity: 6.67 rad/s}}}\n"
         "encoder_steps: 4096\n";
}

sim::physics::BodyPose driven(const RobotDescription& robot, double left, double right) {
  sim::physics::World world(sim::physics::WorldConfig{});
  world.add_robot(kRobot, robot, {});
  const std::array speeds{left, right};
  EXPECT_TRUE(world.set_wheel_speeds(kRobot, speeds));
  for (int i = 0; i < 1000; ++i) world.step();
  EXPECT_TRUE(world.lost_bodies().empty());
  return world.pose(kRobot);
}

class Burger : public testing::TestWithParam<std::array<double, 2>> {};

TEST_P(Burger, EndsWhereTheOneInYamlDoes) {
  const auto [left, right] = GetParam();
  RobotDescription given =
      loaded("include: " + std::string(CONFIG_DIR) + "/robots/turtlebot3_burger.yaml\n").robot;
  const RobotDescription read = loaded(burger()).robot;
  given.acceleration = read.acceleration;  // the file in YAML starts and stops faster
  const auto ours = driven(given, left, right), theirs = driven(read, left, right);
  const double path = 10 * 0.033 * (std::abs(left) + std::abs(right)) / 2;  // m
  EXPECT_NEAR(theirs.position.x, ours.position.x, 0.01 * path);
  EXPECT_NEAR(theirs.position.y, ours.position.y, 0.01 * path);
  const double turned = 10 * 0.033 * std::abs(right - left) / 0.16;  // rad
  const double off = std::remainder(theirs.heading - ours.heading, 2 * 3.14159265358979);
  EXPECT_LE(std::abs(off), 0.01 * turned + 1e-3);
  EXPECT_LT(theirs.tilt, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Speeds, Burger,
                         testing::Values(std::array{6.0, 6.0}, std::array{3.0, 5.0},
                                         std::array{5.0, 3.0}, std::array{-4.0, -4.0},
                                         std::array{2.0, -2.0}));

}  // namespace
}  // namespace programs::models::test
