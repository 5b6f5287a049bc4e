#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "hal/files/config/document.h"
#include "hal/files/description/body_section.h"
#include "hal/node/devices/odometry.h"
#include "hal/types/math.h"
#include "sim/physics/world.h"

/// The shipped robots on other than omnidirectional wheels, against their kinematics.
namespace sim::physics::test {
namespace {

using hal::Twist2;
using hal::node::devices::RobotDescription;
using hal::node::devices::WheelLevel;

constexpr AgentId kRobot{1};

RobotDescription shipped(const std::string& name, WheelLevel level) {
  auto document =
      hal::files::config::Document::load(std::string(CONFIG_DIR) + "/robots/" + name + ".yaml");
  RobotDescription robot = hal::files::description::read_robot(document.root());
  document.finish();
  robot.wheel_level = level;
  return robot;
}

/// A robot file and commands within its limits. m/s, m/s, rad/s
struct Case {
  std::string robot;
  std::vector<Twist2> commands;
};

const std::vector<Case> kCases = {
    {"turtlebot3_burger",
     {{.2, 0, 0}, {-.2, 0, 0}, {0, 0, 2}, {0, 0, -1}, {.15, 0, .8}, {.1, 0, -1}, {-.1, 0, .5}}},
    {"youbot",
     {{.5, 0, 0}, {0, .5, 0}, {0, 0, 1}, {.3, .3, 0}, {.3, 0, .5}, {0, -.3, .8}, {-.2, .2, -.5}}},
    {"rover", {{1, 0, 0}, {-.5, 0, 0}, {0, 0, 1}, {.3, 0, .5}, {-.4, 0, .8}}}};

using Parameter = std::tuple<Case, WheelLevel>;

class Drives : public testing::TestWithParam<Parameter> {
 protected:
  RobotDescription robot() const {
    return shipped(std::get<0>(GetParam()).robot, std::get<1>(GetParam()));
  }
  const std::vector<Twist2>& commands() const { return std::get<0>(GetParam()).commands; }
};

INSTANTIATE_TEST_SUITE_P(Robots, Drives,
                         testing::Combine(testing::ValuesIn(kCases),
                                          testing::Values(WheelLevel::kJointed,
                                                          WheelLevel::kContact)),
                         [](const testing::TestParamInfo<Parameter>& c) {
                           const bool jointed = std::get<1>(c.param) == WheelLevel::kJointed;
                           return std::get<0>(c.param).robot + (jointed ? "Jointed" : "Contact");
                         });

/// Mean velocity of 4 s after 3 s, in the frame that the body had before each step.
Twist2 steady_velocity(const RobotDescription& robot, const Twist2& command) {
  World world(WorldConfig{});
  world.add_robot(kRobot, robot, {0, 0, 0.4});
  EXPECT_TRUE(world.set_body_velocity(kRobot, command));
  for (int k = 0; k < 300; ++k) world.step();
  Twist2 mean;
  for (int k = 0; k < 400; ++k) {
    const double heading = world.pose(kRobot).heading;
    world.step();
    const BodyVelocity v = world.velocity(kRobot);
    const double c = hal::math::cos(heading), s = hal::math::sin(heading);
    mean.vx += (c * v.linear.x + s * v.linear.y) / 400;
    mean.vy += (c * v.linear.y - s * v.linear.x) / 400;
    mean.omega += v.angular.z / 400;
  }
  return mean;
}

/// Deviation of speed, and of rotation, relative to the command. Within a step the body turns by
/// omega * step; whether its velocity belongs to the frame before, amid or after that is the
/// integrator's choice, a constant phase that does not add up: half a turn of it is not counted.
double error(const Twist2& driven, const Twist2& command) {
  const double speed = hal::math::hypot(command.vx, command.vy);
  const double miss = hal::math::hypot(driven.vx - command.vx, driven.vy - command.vy);
  const double phase = 0.5 * 0.01 * std::abs(command.omega) * speed;
  const double turn = std::abs(driven.omega - command.omega);
  return std::max(std::max(0.0, miss - phase) / (speed > 0 ? speed : 1.0),
                  turn / (command.omega == 0 ? 1.0 : std::abs(command.omega)));
}

TEST_P(Drives, SteadyVelocitiesAreTheCommandedOnesWithinHalfAPercent) {
  for (const Twist2& command : commands()) {
    EXPECT_LT(error(steady_velocity(robot(), command), command), 0.005)
        << command.vx << " " << command.vy << " " << command.omega;
  }
}

TEST_P(Drives, OtherFrictionThanTheWheelsOwnIsNoticed) {
  // A mecanum wheel that does not give way, a fixed one that does: the second drifts in a turn.
  RobotDescription wrong = robot();
  const bool has_rollers = wrong.wheels.front().type == hal::node::devices::WheelType::kMecanum;
  for (auto& wheel : wrong.wheels)
    if (wheel.is_driven()) wheel.mu2 = has_rollers ? wheel.mu : 0;
  double worst = 0;
  for (const Twist2& command : commands())
    worst = std::max(worst, error(steady_velocity(wrong, command), command));
  EXPECT_GT(worst, 0.05);
}

TEST_P(Drives, AMinuteOfReversalsDoesNotTipThem) {
  World world(WorldConfig{});
  world.add_robot(kRobot, robot(), {});
  double tilt = 0;
  for (int k = 0; k < 6000; ++k) {
    const double sign = k / 100 % 2 == 0 ? 10 : -10;
    EXPECT_TRUE(world.set_body_velocity(kRobot, {sign, 0, 0}));
    world.step();
    tilt = std::max(tilt, world.pose(kRobot).tilt);
  }
  EXPECT_LT(tilt, 0.01);  // rad
  EXPECT_EQ(world.solver_messages(), 0u);
}

/// Where a point is that drives with a twist along an arc from a pose.
hal::Pose2 on_arc(const hal::Pose2& from, double v, double omega, double seconds) {
  const double turned = omega * seconds;
  return {from.x + v / omega * (hal::math::sin(from.theta + turned) - hal::math::sin(from.theta)),
          from.y - v / omega * (hal::math::cos(from.theta + turned) - hal::math::cos(from.theta)),
          from.theta + turned};
}

/// Distance to the figure of eight of two circles that touch in the origin along x.
double off_eight(const hal::Vec3& p, double radius) {
  return std::min(std::abs(hal::math::hypot(p.x, p.y - radius) - radius),
                  std::abs(hal::math::hypot(p.x, p.y + radius) - radius));
}

/// A figure of eight of two circles: where the body, its odometry and the command were apart most.
struct Eight {
  double path = 0;            ///< m
  double odometry_error = 0;  ///< m
  double off_path = 0;        ///< m, from the two circles
  double off_command = 0;     ///< m, from where the command has it at that time
  double heading_error = 0;   ///< rad, of the odometry
};

Eight drive_eight(const RobotDescription& robot, double radius) {
  constexpr double kSpeed = 0.15;  // m/s; the outer wheel of the smaller circle: 0.174
  World world(WorldConfig{});
  world.add_robot(kRobot, robot, {});
  hal::node::devices::WheelOdometry odometry(world.drive(kRobot), robot.encoder_steps);
  const double around = 2 * hal::math::kPi * radius / kSpeed;  // s
  const int steps = static_cast<int>(std::lround(around / 0.01));
  Eight eight{.path = 4 * hal::math::kPi * radius};
  for (int k = 0; k < 2 * steps; ++k) {
    const double omega = (k < steps ? 1 : -1) * kSpeed / radius;
    EXPECT_TRUE(world.set_body_velocity(kRobot, {kSpeed, 0, omega}));
    world.step();
    odometry.update(world.wheel_angles(kRobot), world.config().step);
    const BodyPose pose = world.pose(kRobot);
    const hal::Pose2 wanted = on_arc({}, kSpeed, omega, 0.01 * (k % steps + 1));
    const auto& told = odometry.pose();
    eight.off_path = std::max(eight.off_path, off_eight(pose.position, radius));
    eight.off_command = std::max(eight.off_command, hal::math::hypot(pose.position.x - wanted.x,
                                                                     pose.position.y - wanted.y));
    eight.odometry_error = std::max(
        eight.odometry_error, hal::math::hypot(told.x - pose.position.x, told.y - pose.position.y));
    eight.heading_error =
        std::max(eight.heading_error, std::abs(hal::math::wrap_angle(told.theta - pose.heading)));
  }
  return eight;
}

TEST_P(Drives, FollowAFigureOfEightOfTwoCirclesOfAMetre) {
  for (const double radius : {0.5, 1.0}) {  // circles of 1 m, by diameter and by radius
    const Eight eight = drive_eight(robot(), radius);
    EXPECT_LT(eight.odometry_error, 0.01 * eight.path) << radius;
    EXPECT_LT(eight.off_path, 0.02 * eight.path) << radius;
    EXPECT_LT(eight.off_command, 0.02 * eight.path) << radius;
    const std::string of = std::to_string(radius);
    RecordProperty("path_" + of, std::to_string(eight.path));
    RecordProperty("odometry_error_" + of, std::to_string(eight.odometry_error));
    RecordProperty("off_path_" + of, std::to_string(eight.off_path));
    RecordProperty("off_command_" + of, std::to_string(eight.off_command));
    RecordProperty("heading_error_" + of, std::to_string(eight.heading_error));
  }
}

TEST(DifferentialRobot, CommandedSidewaysStaysWhereItIs) {
  for (const WheelLevel level : {WheelLevel::kJointed, WheelLevel::kContact}) {
    World world(WorldConfig{});
    world.add_robot(kRobot, shipped("turtlebot3_burger", level), {});
    const auto limited = world.set_body_velocity(kRobot, {0, 0.2, 0});
    ASSERT_TRUE(limited.has_value());
    EXPECT_TRUE(limited->restricted);
    for (int k = 0; k < 300; ++k) world.step();
    EXPECT_NEAR(world.position(kRobot).x, 0, 1e-3);
    EXPECT_NEAR(world.position(kRobot).y, 0, 1e-3);
  }
}

TEST(DifferentialRobot, PushedSidewaysItHolds) {
  // On a slope of 10 degrees across its way it must not slide: tan 10 deg is below mu.
  for (const WheelLevel level : {WheelLevel::kJointed, WheelLevel::kContact}) {
    WorldConfig slope;
    const double angle = 10 * hal::math::kPi / 180;
    slope.down = {0, hal::math::sin(angle), -hal::math::cos(angle)};
    World world(slope);
    world.add_robot(kRobot, shipped("turtlebot3_burger", level), {});
    for (int k = 0; k < 300; ++k) world.step();
    EXPECT_NEAR(world.position(kRobot).y, 0, 5e-3);
  }
}

}  // namespace
}  // namespace sim::physics::test
