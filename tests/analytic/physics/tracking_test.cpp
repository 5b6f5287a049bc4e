#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "hal/devices/odometry.h"
#include "hal/types/math.h"
#include "sim/physics/world.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::physics::test {
namespace {

using hal::Twist2;
using hal::devices::RobotDescription;

/// The commands of replica.md 15. m/s, m/s, rad/s
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

TEST(Tracking, ElevenCommandsAreFollowedWithinATenthOfAPercent) {
  EXPECT_LT(worst_error(steady_velocities(robertino())), 0.001);
}

TEST(Tracking, IsotropicFrictionCannotFollowThem) {
  RobotDescription sticky = robertino();
  for (auto& wheel : sticky.wheels) wheel.mu2 = wheel.mu;
  EXPECT_GT(worst_error(steady_velocities(sticky)), 0.1);
}

/// Drives along y, 0.9 m/s to and fro. @return largest tilt and largest turn seen, rad.
std::pair<double, double> reverse(const RobotDescription& description) {
  World world(WorldConfig{});
  world.add_robot(robot(0), description, {});
  double tilt = 0;
  double turn = 0;
  for (int k = 0; k < 2000; ++k) {
    if (k % 250 == 0) {
      const double sign = k % 500 == 0 ? 1 : -1;
      EXPECT_TRUE(world.set_body_velocity(robot(0), {0, 0.9 * sign, 0}));
    }
    world.step();
    const BodyPose pose = world.pose(robot(0));
    tilt = std::max(tilt, pose.tilt);
    turn = std::max(turn, std::abs(pose.heading));
  }
  return {tilt, turn};
}

TEST(Tracking, ReversalsNeitherTipNorTurnTheRobot) {
  const auto [tilt, turn] = reverse(robertino());
  EXPECT_LT(tilt, 1e-3);  // rad; 3e-4 was measured
  EXPECT_LT(turn, 0.02);  // rad
}

TEST(Tracking, ReversalsWithoutAccelerationLimitsTurnTheRobot) {
  RobotDescription abrupt = robertino();
  abrupt.acceleration = {1e6, 1e6, 1e6, 1e6};
  EXPECT_GT(reverse(abrupt).second, 0.5);  // rad; more than 0.9 was measured
}

TEST(Tracking, WheelAnglesLeadOdometryToTheTruePose) {
  World world(WorldConfig{});
  world.add_robot(robot(0), robertino(), {});
  hal::devices::WheelOdometry odometry(world.drive(robot(0)));
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

}  // namespace
}  // namespace sim::physics::test
