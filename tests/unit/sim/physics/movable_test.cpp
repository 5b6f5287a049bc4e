// Movables at rest, in stacks, tipped over and pushed together.
#include "sim/physics/movable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "hal/types/math.h"
#include "sim/core/fingerprint.h"
#include "sim/physics/world.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::physics::test {
namespace {

using hal::math::kPi;

constexpr AgentId kRobot{1};

void advance(World& world, double seconds) {
  const hal::Time end = world.now() + hal::from_seconds(seconds);
  while (world.now() < end) world.step();
}

using Form = decltype(Movable::form);

Movable movable(const Form& form, const hal::Pose2& pose, double elevation = 0) {
  Movable made{.name = "thing", .form = form, .pose = pose, .elevation = elevation};
  made.mass = 2;
  return made;
}

constexpr MovableBox kCube{{0.3, 0.3, 0.2}};
constexpr MovableCylinder kDrum{0.15, 0.2};

/// Twenty stacks of three, of boxes, of cylinders and of both; and twenty boxes and twenty spheres.
void add_hundred(World& world) {
  for (int i = 0; i < 60; ++i) {
    const int stack = i / 3, level = i % 3;
    const bool drum = stack % 3 == 0 || (stack % 3 == 1 && level == 1);
    const double shifted = stack % 2 == 0 ? 0 : 0.01 * level;  // m
    world.add_movable(movable(drum ? Form{kDrum} : Form{kCube},
                              {1.0 * stack, shifted, shifted * stack}, 0.2 * level));
  }
  for (int i = 0; i < 20; ++i) world.add_movable(movable(kCube, {1.0 * i, 2, 0.3 * i}));
  for (int i = 0; i < 20; ++i)
    world.add_movable(movable(MovableSphere{0.05 + 0.01 * i}, {1.0 * i, 4, 0}));
}

std::vector<hal::Vec3> places(const World& world) {
  std::vector<hal::Vec3> all;
  for (std::size_t i = 0; i < world.movable_count(); ++i)
    all.push_back(world.movable(i).pose.position);
  return all;
}

double farthest(const std::vector<hal::Vec3>& before, const std::vector<hal::Vec3>& after) {
  double most = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const hal::Vec3 way = after[i] - before[i];
    most = std::max(most, std::sqrt(hal::dot(way, way)));
  }
  return most;
}

TEST(Movable, AHundredAtRestDoNotMove) {
  World world(WorldConfig{});
  add_hundred(world);
  const auto put = places(world);
  advance(world, 2);
  EXPECT_LT(farthest(put, places(world)), 2e-3);  // m; three surface layers, and the stacks stand
  const auto settled = places(world);
  double most = 0;
  for (int second = 0; second < 60; ++second) {
    advance(world, 1);
    most = std::max(most, farthest(settled, places(world)));
  }
  EXPECT_LT(most, 1e-4);  // m
  EXPECT_EQ(world.solver_messages(), 0U);
  EXPECT_TRUE(world.lost_bodies().empty());
}

TEST(Movable, LeaningOnAParkedRobotDoesNotMove) {
  World world(WorldConfig{});
  world.add_robot(kRobot, robertino(), {});
  world.add_movable(movable(kCube, {0.335, 0, 0}));  // 0.185 m and half of 0.3 m: they touch
  world.add_movable(movable(kCube, {0.635, 0, 0}));
  advance(world, 2);
  const auto settled = places(world);
  advance(world, 60);
  EXPECT_LT(farthest(settled, places(world)), 1e-4);  // m
}

/// A robot pushes with 0.3 m/s for 3 s, then stops.
void push(World& world) {
  EXPECT_TRUE(world.set_body_velocity(kRobot, {0.3, 0, 0}));
  advance(world, 3);
  EXPECT_TRUE(world.set_body_velocity(kRobot, {}));
  advance(world, 2);
}

TEST(Movable, IsPushedAndBothRecordIt) {
  for (const Form& form : {Form{kCube}, Form{kDrum}, Form{MovableSphere{0.1}}}) {
    World world(WorldConfig{});
    world.add_robot(kRobot, robertino(), {});
    world.add_movable(movable(form, {0.6, 0, 0}));
    advance(world, 1);
    ASSERT_TRUE(world.movable(0).asleep);
    push(world);
    EXPECT_GT(world.movable(0).pose.position.x, world.position(kRobot).x + 0.185);
    EXPECT_GT(world.movable(0).pose.position.x, 0.8) << form.index();
    EXPECT_GT(world.contacts(kRobot).movables.steps, 0U);
    EXPECT_EQ(world.contacts(kRobot).bodies.steps, world.contacts(kRobot).movables.steps);
    EXPECT_EQ(world.movable_contacts(0).robots.first, world.contacts(kRobot).movables.first);
    EXPECT_EQ(world.solver_messages(), 0U);
  }
}

TEST(Movable, RowIsPushedWithoutOverlapping) {
  World world(WorldConfig{});
  world.add_robot(kRobot, robertino(), {});
  for (int i = 0; i < 3; ++i) {
    Movable light = movable(kCube, {0.6 + 0.31 * i, 0.02 * i, 0});
    light.mass = 0.5;
    world.add_movable(light);
  }
  push(world);
  for (std::size_t i = 1; i < 3; ++i)
    EXPECT_GT(world.movable(i).pose.position.x - world.movable(i - 1).pose.position.x, 0.297);
  EXPECT_GT(world.movable(0).pose.position.x, 0.9);
}

TEST(Movable, StopsAtAWall) {
  World world(WorldConfig{});
  world.add_wall({.name = "wall", .centre = {1, 0, 0.5}, .size = {0.2, 2, 1}});
  Movable thrown = movable(kCube, {0, 0, 0});
  thrown.velocity = {3, 0};
  thrown.friction = 0.1;
  world.add_movable(thrown);
  advance(world, 3);
  EXPECT_NEAR(world.movable(0).pose.position.x, 0.75, 0.02);
  EXPECT_GT(world.movable_contacts(0).walls.steps, 0U);
}

TEST(Movable, FallsFromItsElevation) {
  World world(WorldConfig{});
  world.add_movable(movable(kCube, {}, 1));
  EXPECT_DOUBLE_EQ(world.movable(0).pose.position.z, 1.1);
  advance(world, 0.4);
  // h - g t^2 / 2; ODE's integrator is g t dt / 2 ahead: 0.02 m.
  EXPECT_NEAR(world.movable(0).pose.position.z, 1.1 - 0.5 * 9.81 * 0.16, 0.025);
  advance(world, 2);
  EXPECT_NEAR(world.movable(0).pose.position.z, 0.1, 2e-4);
  EXPECT_TRUE(world.lost_bodies().empty());
}

TEST(Movable, CylinderOnItsSideIsSeenAsABox) {
  World world(WorldConfig{});
  world.add_robot(kRobot, robertino(), {});
  Movable pole = movable(MovableCylinder{0.05, 0.8}, {1, 0, 0});
  pole.velocity = {2, 0};  // its foot is held: it tips over
  pole.friction = 5;
  WorldConfig rough;
  rough.ground_friction = 5;
  World tipping(rough);
  tipping.add_movable(pole);
  EXPECT_EQ(tipping.movable_shape(0).kind, Shape::Kind::kCylinder);
  EXPECT_DOUBLE_EQ(tipping.movable_shape(0).z_high, 0.8);
  tipping.step();
  advance(tipping, 5);
  const Shape& lying = tipping.movable_shape(0);
  ASSERT_EQ(lying.kind, Shape::Kind::kBox);
  EXPECT_NEAR(lying.half.x, 0.4, 1e-12);
  EXPECT_NEAR(lying.half.y, 0.05, 1e-12);
  EXPECT_NEAR(lying.z_low, 0, 2e-3);
  EXPECT_NEAR(lying.z_high, 0.1, 2e-3);
  EXPECT_TRUE(tipping.lost_bodies().empty());  // a movable may lie on its side
}

TEST(Movable, BlownUpIsLostWithItsNumber) {
  World world(WorldConfig{});
  world.add_movable(movable(kCube, {}));
  Movable fast = movable(kCube, {5, 0, 0});
  fast.velocity = {2e5, 0};
  world.add_movable(fast);
  world.step();
  ASSERT_EQ(world.lost_bodies().size(), 1U);
  EXPECT_EQ(world.lost_bodies()[0].movable, 1U);
  EXPECT_EQ(world.lost_bodies()[0].agent, AgentId{});
}

TEST(Movable, MustBePossible) {
  World world(WorldConfig{});
  EXPECT_THROW(world.add_movable(movable(MovableBox{{0.1, 0, 0.1}}, {})), std::invalid_argument);
  EXPECT_THROW(world.add_movable(movable(MovableSphere{-1}, {})), std::invalid_argument);
  EXPECT_THROW(world.add_movable(movable(kCube, {}, -0.1)), std::invalid_argument);
  Movable massless = movable(kCube, {});
  massless.mass = 0;
  EXPECT_THROW(world.add_movable(massless), std::invalid_argument);
  EXPECT_EQ(world.movable_count(), 0U);
}

/// Hash of everything after two robots have pushed into twelve movables.
std::uint64_t pushed_hash() {
  World world(WorldConfig{});
  world.add_robot(kRobot, robertino(), {});
  world.add_robot(AgentId{2}, robertino(), {4, 0, kPi});
  for (int i = 0; i < 12; ++i) {
    const Form form = i % 3 == 0   ? Form{kDrum}
                      : i % 3 == 1 ? Form{kCube}
                                   : Form{MovableSphere{0.12}};
    world.add_movable(movable(form, {1.2 + 0.4 * (i % 4), 0.35 * (i / 4) - 0.35, 0.1 * i}));
  }
  for (const AgentId robot : {kRobot, AgentId{2}})
    EXPECT_TRUE(world.set_body_velocity(robot, {0.5, 0, 0}));
  Hash hash;
  for (int step = 0; step < 600; ++step) {
    world.step();
    for (std::size_t i = 0; i < world.movable_count(); ++i) {
      const hal::Vec3 p = world.movable(i).pose.position;
      for (const double value : {p.x, p.y, p.z}) hash.add(value);
    }
  }
  EXPECT_GT(world.jammed_steps(), 0U);
  return hash.value();
}

TEST(Movable, EqualRunsAreEqualToTheLastBit) { EXPECT_EQ(pushed_hash(), pushed_hash()); }

}  // namespace
}  // namespace sim::physics::test
