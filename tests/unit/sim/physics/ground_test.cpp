// Bodies on a ground that is not the plane z = 0.
#include "sim/core/ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "sim/physics/world.h"
#include "tests/support/slope.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::physics::test {
namespace {

using hal::node::devices::MoteDescription;
using hal::node::devices::RobotDescription;
using hal::node::devices::Wheel;
using hal::node::devices::WheelLevel;
using hal::node::devices::WheelType;

constexpr AgentId kRobot{1}, kMote{2};
constexpr double kGrade = 0.1;
constexpr double kFoot = -10;  // m: far below what would be lost on the plane z = 0

WorldConfig on_slope(double foot, double grade) {
  return {.ground = std::make_shared<tests::Slope>(foot, grade)};
}

/// m, of a body's origin above the ground, along its normal.
double above(const World& world, AgentId agent) {
  const Ground& ground = *world.config().ground;
  const hal::Vec3 p = world.position(agent);
  return ground.normal({p.x, p.y}).z * (p.z - ground.height({p.x, p.y}));
}

void run(World& world, int steps) {
  for (int i = 0; i < steps; ++i) world.step();
}

/// Two fixed wheels and a ball caster, which carries a third of the weight.
RobotDescription with_caster(WheelLevel level) {
  RobotDescription robot = robertino(level);
  robot.wheels = {{{0, 0.15}, 0, 0.04, 0.2, 0.6, 0.6, 1.0, 23, WheelType::kFixed},
                  {{0, -0.15}, 0, 0.04, 0.2, 0.6, 0.6, 1.0, 23, WheelType::kFixed},
                  {{-0.15, 0}, 0, 0.03, 0.1, 0.05, 0.05, 0, 0, WheelType::kCaster}};
  for (int i = 0; i < 2; ++i) robot.wheels[i].axle_heading = -hal::math::kPi / 2;
  return robot;
}

class OnASlope : public testing::TestWithParam<WheelLevel> {};

TEST_P(OnASlope, BodiesArePutUprightOnTheGround) {
  World world(on_slope(kFoot, kGrade));
  world.add_robot(kRobot, robertino(GetParam()), {2, 3, 1});
  world.add_mote(kMote, {}, {-5, 3, 0});
  for (const AgentId agent : {kRobot, kMote}) {
    EXPECT_NEAR(above(world, agent), 0, 1e-12);
    EXPECT_NEAR(world.pose(agent).tilt, std::atan(kGrade), 1e-12);
  }
  EXPECT_NEAR(world.position(kRobot).z, kFoot + 2 * kGrade, 1e-12);
  world.place(kRobot, {40, 0, 2});
  world.step();
  EXPECT_NEAR(world.position(kRobot).z, kFoot + 40 * kGrade, 1e-3);
  EXPECT_NEAR(world.pose(kRobot).tilt, std::atan(kGrade), 1e-2);
}

TEST_P(OnASlope, WheelsCastersAndMotesRestOnIt) {
  World world(on_slope(kFoot, kGrade));
  world.add_robot(kRobot, with_caster(GetParam()), {0, 0, 0});
  world.add_mote(kMote, {}, {5, 0, 0});
  run(world, 300);
  for (const AgentId agent : {kRobot, kMote}) {
    EXPECT_NEAR(above(world, agent), 0, 2e-3);  // m, what contacts give way
    EXPECT_NEAR(world.pose(agent).tilt, std::atan(kGrade), 5e-3);
  }
  EXPECT_NEAR(world.position(kMote).x, 5, 2e-3) << "friction 0.6 holds it";
  EXPECT_TRUE(world.lost_bodies().empty());
}

/// Where a robot with weak motors is after two seconds on a slope that gives way by a micrometre
/// before the first step: so no rounding decides whether it touches the ground at the start.
hal::Vec3 driven(WorldConfig config, double grade, WheelLevel level) {
  RobotDescription robot = robertino(level);
  for (Wheel& wheel : robot.wheels) wheel.max_torque = 0.12;  // N m: too weak now and then
  const auto ground = std::make_shared<tests::Slope>(0, grade);
  config.ground = ground;
  World world(config);
  world.add_robot(kRobot, robot, {0, 0, 0});
  ground->sink(1e-6 * std::sqrt(1 + grade * grade));
  (void)world.set_body_velocity(kRobot, {0.5, 0.1, 0.4});
  run(world, 200);
  return world.position(kRobot);
}

/// What gravity along (0, 0, -1) does on a slope, gravity along the other way does on the plane.
TEST_P(OnASlope, ARobotDrivesAsOnThePlaneWithGravityTurned) {
  const double turn = std::atan(kGrade), c = std::cos(turn), s = std::sin(turn);
  const hal::Vec3 a = driven({.down = {-s, 0, -c}}, 0, GetParam());
  const hal::Vec3 b = driven({}, kGrade, GetParam());
  EXPECT_GT(std::hypot(a.x, a.y), 0.2) << "it moved";
  // m, rad; rounding, which two seconds of contacts make larger
  EXPECT_NEAR(c * b.x + s * b.z, a.x, 1e-6);
  EXPECT_NEAR(b.y, a.y, 1e-6);
  EXPECT_NEAR(c * b.z - s * b.x, a.z, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Levels, OnASlope, kLevels, level_name);

TEST(Ground, OneThatIsSteepTipsNobodyOver) {
  World world(on_slope(0, 2));  // 63 degrees; a body is lost from 57 degrees on, against the ground
  world.add_mote(kMote, {}, {0, 0, 0});
  world.step();
  EXPECT_GT(world.pose(kMote).tilt, 1);
  EXPECT_TRUE(world.lost_bodies().empty());
}

/// Level, and higher when the test says so.
class Rising final : public Ground {
 public:
  double height(hal::Vec2) const override { return z; }
  hal::Vec3 normal(hal::Vec2) const override { return {0, 0, 1}; }
  double z = 0;  ///< m
};

TEST(Ground, WhoIsBelowItIsLost) {
  const auto ground = std::make_shared<Rising>();
  World world({.ground = ground});
  world.add_mote(kMote, {}, {0, 0, 0});
  world.step();
  EXPECT_TRUE(world.lost_bodies().empty());
  ground->z = 0.5;
  world.step();
  ASSERT_EQ(world.lost_bodies().size(), 1u);
  EXPECT_EQ(world.lost_bodies()[0].how, BodyLoss::kBelowGround);
}

TEST(Ground, MustBeThere) { EXPECT_THROW(World({.ground = nullptr}), std::invalid_argument); }

}  // namespace
}  // namespace sim::physics::test
