#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "hal/node/devices/odometry.h"
#include "hal/types/math.h"
#include "sim/physics/world.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::physics::test {
namespace {

using hal::Twist2;
using hal::node::devices::RobotDescription;
using hal::node::devices::WheelLevel;

/// The commands of docs/models.md, 5. m/s, m/s, rad/s
constexpr std::array<Twist2, 11> kCommands{{{.3, 0, 0},
                                            {0, .3, 0},
                                            {0, 0, 1},
                                            {.9, 0, 0},
                                            {0, .9, 0},
                                            {0, 0, 2},
                                            {.3, .3, 0},
                                            {.5, 0, .5},
                                            {0, .5, 1},
                                            {.6, 0, 2},
                                            {.4, -.4, -2}}};

AgentId robot(std::size_t i) { return AgentId{static_cast<std::uint16_t>(i + 1)}; }

/// Velocity over one step in the frame the body had before it; with the frame after it, rotation
/// alone would look like a sideways error.
Twist2 step_velocity(const World& world, AgentId agent, double heading_before) {
  const BodyVelocity v = world.velocity(agent);
  const double c = hal::math::cos(heading_before);
  const double s = hal::math::sin(heading_before);
  return {c * v.linear.x + s * v.linear.y, c * v.linear.y - s * v.linear.x, v.angular.z};
}

/// Mean velocities of 4 s after 5 s, one robot per command, far apart.
std::array<Twist2, 11> steady_velocities(const RobotDescription& description) {
  World world(WorldConfig{});
  for (std::size_t i = 0; i < kCommands.size(); ++i) {
    world.add_robot(robot(i), description, {50.0 * static_cast<double>(i), 0, 0.4});
    EXPECT_TRUE(world.set_body_velocity(robot(i), kCommands[i]));
  }
  for (int k = 0; k < 500; ++k) world.step();
  std::array<Twist2, 11> sums{};
  for (int k = 0; k < 400; ++k) {
    std::array<double, 11> headings{};
    for (std::size_t i = 0; i < sums.size(); ++i) headings[i] = world.pose(robot(i)).heading;
    world.step();
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const Twist2 v = step_velocity(world, robot(i), headings[i]);
      sums[i] = {sums[i].vx + v.vx / 400, sums[i].vy + v.vy / 400, sums[i].omega + v.omega / 400};
    }
  }
  return sums;
}

/// Largest deviation of speed and rotation, relative to the command.
double worst_error(const std::array<Twist2, 11>& driven) {
  double worst = 0;
  for (std::size_t i = 0; i < driven.size(); ++i) {
    const Twist2& c = kCommands[i];
    const double speed = hal::math::hypot(c.vx, c.vy);
    const double miss = hal::math::hypot(driven[i].vx - c.vx, driven[i].vy - c.vy);
    worst = std::max(worst, miss / (speed > 0 ? speed : 1.0));
    worst = std::max(
        worst, std::abs(driven[i].omega - c.omega) / (c.omega == 0 ? 1.0 : std::abs(c.omega)));
  }
  return worst;
}

class Tracking : public testing::TestWithParam<WheelLevel> {};
INSTANTIATE_TEST_SUITE_P(Levels, Tracking, kLevels, level_name);

TEST_P(Tracking, ElevenCommandsAreFollowedWithinATenthOfAPercent) {
  EXPECT_LT(worst_error(steady_velocities(robertino(GetParam()))), 0.001);
}

TEST_P(Tracking, IsotropicFrictionCannotFollowThem) {
  RobotDescription sticky = robertino(GetParam());
  for (auto& wheel : sticky.wheels) wheel.mu2 = wheel.mu;
  EXPECT_GT(worst_error(steady_velocities(sticky)), 0.1);
}

struct Swing {
  double tilt = 0;  ///< rad, largest
  double turn = 0;  ///< rad, largest
};

/// Drives to and fro with `speed`, reversing every 2.5 s.
Swing reverse(const RobotDescription& description, const Twist2& speed, int steps) {
  World world(WorldConfig{});
  world.add_robot(robot(0), description, {});
  Swing swing;
  for (int k = 0; k < steps; ++k) {
    if (k % 250 == 0) {
      const double sign = k % 500 == 0 ? 1 : -1;
      EXPECT_TRUE(world.set_body_velocity(robot(0), {sign * speed.vx, sign * speed.vy, 0}));
    }
    world.step();
    const BodyPose pose = world.pose(robot(0));
    swing.tilt = std::max(swing.tilt, pose.tilt);
    swing.turn = std::max(swing.turn, std::abs(pose.heading));
  }
  return swing;
}

TEST_P(Tracking, AMinuteOfReversalsNeitherTipsNorTurnsTheRobot) {
  for (const Twist2& speed : {Twist2{0.9, 0, 0}, Twist2{0, 0.9, 0}}) {
    const Swing swing = reverse(robertino(GetParam()), speed, 6000);
    EXPECT_LT(swing.tilt, 1e-3) << speed.vx;  // rad; 3e-4 was measured
    EXPECT_LT(swing.turn, 0.02) << speed.vx;  // rad
  }
}

TEST(TrackingJointed, ReversalsWithoutAccelerationLimitsTurnTheRobot) {
  RobotDescription abrupt = robertino();
  abrupt.acceleration = {1e6, 1e6, 1e6, 1e6};
  EXPECT_GT(reverse(abrupt, {0, 0.9, 0}, 2000).turn, 0.5);  // rad; more than 0.9 was measured
}

TEST_P(Tracking, WheelAnglesLeadOdometryToTheTruePose) {
  World world(WorldConfig{});
  world.add_robot(robot(0), robertino(GetParam()), {});
  hal::node::devices::WheelOdometry odometry(world.drive(robot(0)));
  for (int k = 0; k < 1000; ++k) {
    if (k % 200 == 0) {
      const Twist2& command = kCommands[static_cast<std::size_t>(k / 200) + 6];
      ASSERT_TRUE(world.set_body_velocity(robot(0), command));
    }
    world.step();
    odometry.update(world.wheel_angles(robot(0)), world.config().step);
  }
  const BodyPose pose = world.pose(robot(0));
  // Driven: about 5 m and 8 rad. Wheels slip while the velocity changes: 1 % is allowed.
  EXPECT_NEAR(odometry.pose().x, pose.position.x, 0.05);
  EXPECT_NEAR(odometry.pose().y, pose.position.y, 0.05);
  EXPECT_NEAR(hal::math::wrap_angle(odometry.pose().theta - pose.heading), 0, 0.05);
}

/// Turns of the wheels, as metres rolled, that a robot counts on its way along x against a wall.
double rolled_against_a_wall(const RobotDescription& description) {
  World world(WorldConfig{});
  world.add_wall({"wall", {1, 0, 0.5}, {0.2, 4, 1}, 0});
  world.add_robot(robot(0), description, {});
  hal::node::devices::WheelOdometry odometry(world.drive(robot(0)));
  EXPECT_TRUE(world.set_body_velocity(robot(0), {0.5, 0, 0}));
  for (int k = 0; k < 1000; ++k) world.step();
  odometry.update(world.wheel_angles(robot(0)), world.now() - hal::Time{});
  EXPECT_NEAR(world.pose(robot(0)).position.x, 0.9 - 0.185, 0.003);  // m: it did not climb
  return odometry.pose().x;
}

TEST_P(Tracking, StrongMotorsSpinTheWheelsBeforeAWall) {
  RobotDescription strong = robertino(GetParam());
  for (auto& wheel : strong.wheels) wheel.max_torque = 10;
  // m: 0.5 m/s for 10 s less 0.156 m for the ramp; the first 0.715 m it really moved.
  EXPECT_NEAR(rolled_against_a_wall(strong), 5 - 0.156, 0.02);
}

TEST_P(Tracking, WeakMotorsStallBeforeAWall) {
  RobotDescription weak = robertino(GetParam());
  for (auto& wheel : weak.wheels) wheel.max_torque = 0.5;  // 12.5 N where the tyre grips 22 N
  EXPECT_NEAR(rolled_against_a_wall(weak), 0.715, 0.02);   // m
}

}  // namespace
}  // namespace sim::physics::test
