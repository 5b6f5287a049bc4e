// Coulomb's law and rolling of movables, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <tuple>

#include "hal/types/math.h"
#include "sim/physics/world.h"
#include "tests/support/slope.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::physics::test {
namespace {

using hal::math::kPi;

constexpr double kGravity = 9.81;  // m/s^2

void run_for(World& world, double seconds) {
  const hal::Time end = world.now() + hal::from_seconds(seconds);
  while (world.now() < end) world.step();
}

Movable box(double mass) {
  Movable made{.name = "box", .form = MovableBox{{0.4, 0.3, 0.1}}};
  made.mass = mass;
  return made;
}

Movable cylinder(double mass) {
  Movable made{.name = "drum", .form = MovableCylinder{0.2, 0.1}};
  made.mass = mass;
  return made;
}

Movable sphere(double radius) { return {.name = "ball", .form = MovableSphere{radius}}; }

double distance(const hal::Vec3& a, const hal::Vec3& b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

class Sliding : public testing::TestWithParam<std::tuple<bool, double, double, double, double>> {};

TEST_P(Sliding, StopsAfterTheDistanceOfCoulombsLaw) {
  const auto [is_box, mass, mu, degrees, speed] = GetParam();
  Movable thing = is_box ? box(mass) : cylinder(mass);
  const double heading = degrees * kPi / 180;
  thing.velocity = {speed * hal::math::cos(heading), speed * hal::math::sin(heading)};
  thing.friction = mu;
  World world(WorldConfig{});
  world.add_movable(thing);
  const hal::Vec3 start = world.movable(0).pose.position;
  run_for(world, speed / (mu * kGravity) + 1);
  const double way = distance(world.movable(0).pose.position, start);
  const double expected = speed * speed / (2 * mu * kGravity);
  EXPECT_NEAR(way, expected, 0.02 * expected);
  EXPECT_NEAR(hal::math::atan2(world.movable(0).pose.position.y, world.movable(0).pose.position.x),
              heading, 0.01);  // rad; it keeps its course
  EXPECT_TRUE(world.movable(0).asleep);
  EXPECT_EQ(world.solver_messages(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Forms, Sliding,
                         testing::Combine(testing::Bool(), testing::Values(0.5, 20.0),
                                          testing::Values(0.1, 0.3, 0.6),
                                          testing::Values(0.0, 30.0, 45.0),
                                          testing::Values(0.5, 1.0, 2.0)));

/// Along the diagonal of ODE's axes of friction a body held up to 1.41 times too much.
class OnSlope : public testing::TestWithParam<std::tuple<bool, double>> {};

constexpr double kMu = 0.3;

/// On a slope whose tangent is `share` of the coefficient of friction.
std::unique_ptr<World> on_slope(bool is_box, double yaw, double share) {
  WorldConfig config;
  config.ground = std::make_shared<tests::Slope>(0, share * kMu);
  Movable thing = is_box ? box(3) : cylinder(3);
  thing.friction = kMu;
  thing.pose.theta = yaw;
  auto world = std::make_unique<World>(config);
  world->add_movable(thing);
  return world;
}

double speed(const World& world) {
  const hal::Vec3 v = world.movable(0).velocity.linear;
  return std::sqrt(hal::dot(v, v));
}

TEST_P(OnSlope, RestsBelowTheAngleOfFriction) {
  const auto [is_box, degrees] = GetParam();
  const auto world = on_slope(is_box, degrees * kPi / 180, 0.98);
  run_for(*world, 2);  // it touches down and comes to rest
  const hal::Vec3 place = world->movable(0).pose.position;
  run_for(*world, 60);
  EXPECT_LT(distance(world->movable(0).pose.position, place), 1e-4);  // m
}

TEST_P(OnSlope, SlidesAboveTheAngleOfFriction) {
  const auto [is_box, degrees] = GetParam();
  const auto world = on_slope(is_box, degrees * kPi / 180, 1.02);
  run_for(*world, 1);  // it touches down
  const double before = speed(*world);
  run_for(*world, 1);
  const double grade = 1.02 * kMu;
  const double expected = kGravity / std::sqrt(1 + grade * grade) * (grade - kMu);  // m/s^2
  EXPECT_NEAR(speed(*world) - before, expected, 0.02 * expected);
}

INSTANTIATE_TEST_SUITE_P(Yaws, OnSlope,
                         testing::Combine(testing::Bool(), testing::Values(0.0, 30.0, 45.0)));

TEST(Rolling, BallThatStartsBySlidingRollsAtFiveSeventhsOfItsSpeed) {
  Movable ball = sphere(0.1);
  ball.velocity = {1, 0};
  ball.friction = 0.3;
  ball.rolling_resistance = 0;
  World world(WorldConfig{});
  world.add_movable(ball);
  run_for(world, 2);
  EXPECT_NEAR(world.movable(0).velocity.linear.x, 5.0 / 7, 0.005);
  EXPECT_NEAR(world.movable(0).velocity.angular.y, 5.0 / 7 / 0.1, 0.05);
}

TEST(Rolling, BallStopsByItsRollingResistance) {
  Movable ball = sphere(0.1);
  ball.velocity = {1, 0};
  ball.rolling_resistance = 0.02;
  World world(WorldConfig{});
  world.add_movable(ball);
  run_for(world, 1);
  const double from = world.movable(0).velocity.linear.x;
  run_for(world, 2);
  EXPECT_NEAR(from - world.movable(0).velocity.linear.x, 2 * 5.0 / 7 * 0.02 * kGravity,
              0.02 * 2 * 5.0 / 7 * 0.02 * kGravity);
  run_for(world, 10);
  EXPECT_TRUE(world.movable(0).asleep);
}

TEST(Rolling, BallWithoutResistanceRollsOn) {
  Movable ball = sphere(0.1);
  ball.velocity = {0.5, 0};
  ball.rolling_resistance = 0;
  World world(WorldConfig{});
  world.add_movable(ball);
  run_for(world, 2);
  const double rolling = world.movable(0).velocity.linear.x;
  run_for(world, 20);
  EXPECT_NEAR(world.movable(0).velocity.linear.x, rolling, 1e-4 * rolling);
}

/// Work of the motors over 1 m at a steady speed, J.
double work_over_a_metre(double mass, double mu, double yaw) {
  WorldConfig config;
  config.measure_energy = true;
  World world(config);
  world.add_robot(AgentId{1}, robertino(), {0, 0, yaw});
  if (mass > 0) {
    Movable pushed = box(mass);
    pushed.friction = mu;
    const hal::Vec2 ahead{hal::math::cos(yaw), hal::math::sin(yaw)};
    pushed.pose = {0.4 * ahead.x, 0.4 * ahead.y, yaw};
    world.add_movable(pushed);
  }
  EXPECT_TRUE(world.set_body_velocity(AgentId{1}, {0.2, 0, 0}));
  run_for(world, 4);
  const double work = world.energy(AgentId{1}).motor_work;
  const hal::Vec3 from = world.position(AgentId{1});
  while (distance(world.position(AgentId{1}), from) < 1) world.step();
  return (world.energy(AgentId{1}).motor_work - work) / distance(world.position(AgentId{1}), from);
}

TEST(Pushing, TakesTheForceOfCoulombsLaw) {
  for (const double degrees : {0.0, 30.0, 45.0}) {
    const double yaw = degrees * kPi / 180;
    const double free = work_over_a_metre(0, 0, yaw);
    for (const double mass : {1.0, 4.0}) {
      const double force = 0.3 * mass * kGravity;
      EXPECT_NEAR(work_over_a_metre(mass, 0.3, yaw) - free, force, 0.02 * force)
          << degrees << " degrees, " << mass << " kg";
    }
  }
}

}  // namespace
}  // namespace sim::physics::test
