#include "sim/physics/wall_tree.h"

#include <gtest/gtest.h>

#include "hal/types/math.h"
#include "hal/types/random.h"
#include "sim/physics/world.h"

namespace sim::physics {
namespace {

constexpr hal::AgentId kRobot{1};

std::vector<Shape> scattered_walls(std::size_t count, hal::RandomStream& random) {
  std::vector<Shape> walls(count);
  for (Shape& wall : walls) {
    const double angle = 6.3 * random.uniform();
    wall.axis = {hal::math::cos(angle), hal::math::sin(angle)};
    wall.centre = {100 * random.uniform(), 100 * random.uniform()};
    wall.half = {3 * random.uniform(), 0.2 * random.uniform()};
  }
  return walls;
}

double distance_to_centre(hal::Vec2 point, const Shape& wall) {
  const hal::Vec2 away = wall.centre - point;
  return std::sqrt(hal::dot(away, away));
}

TEST(WallTree, FindsTheNearestOfAll) {
  hal::RandomStream random(1, "walls");
  for (const std::size_t count : {0U, 1U, 5U, 64U, 1000U}) {
    const std::vector<Shape> walls = scattered_walls(count, random);
    const WallTree tree(walls);
    for (int k = 0; k < 200; ++k) {
      const hal::Vec2 at{140 * random.uniform() - 20, 140 * random.uniform() - 20};
      double expected = std::numeric_limits<double>::infinity();
      for (const Shape& wall : walls) expected = std::min(expected, distance_to_centre(at, wall));
      std::size_t asked = 0;
      EXPECT_EQ(tree.nearest(at,
                             [&](std::uint32_t i) {
                               ++asked;
                               return distance_to_centre(at, walls[i]);
                             }),
                expected);
      EXPECT_LE(asked, std::max<std::size_t>(count / 4, 64));
    }
  }
}

TEST(WallTree, FindsWhatMayBeInABox) {
  hal::RandomStream random(2, "walls");
  const std::vector<Shape> walls = scattered_walls(500, random);
  const WallTree tree(walls);
  for (int k = 0; k < 200; ++k) {
    const hal::Vec2 low{100 * random.uniform(), 100 * random.uniform()};
    const hal::Vec2 high = low + hal::Vec2{5, 2};
    std::vector<std::uint32_t> found;
    tree.overlapping({low, high}, found);
    EXPECT_TRUE(std::ranges::is_sorted(found));
    for (std::uint32_t i = 0; i < walls.size(); ++i) {
      const hal::Vec2 at = walls[i].centre;
      const bool is_in = at.x > low.x && at.x < high.x && at.y > low.y && at.y < high.y;
      EXPECT_TRUE(!is_in || std::ranges::count(found, i) == 1);
    }
  }
}

hal::node::devices::RobotDescription cart() {
  hal::node::devices::RobotDescription robot;
  robot.model = "cart";
  robot.wheel_level = hal::node::devices::WheelLevel::kContact;
  robot.cylinders = {{0.18, 0.02, 0.20, {}, 3.5}};
  robot.friction = 0.3;
  for (int i = 0; i < 3; ++i) {
    const double heading = 2 * hal::math::kPi * i / 3;
    const hal::Vec2 place = 0.155 * hal::Vec2{hal::math::cos(heading), hal::math::sin(heading)};
    robot.wheels.push_back({place, heading, 0.04, 0.3, 0.6, 0, 0.3, 50});
  }
  return robot;
}

/// A robot that drives against a wall for 10 s, with so many more walls far away.
struct Crash {
  hal::Vec3 end;
  std::uint64_t touches = 0;
};
Crash crash(int more) {
  World world(WorldConfig{});
  world.add_wall({.name = "near", .centre = {1, 0.3, 0.5}, .size = {0.2, 4, 1}, .yaw = 0.2});
  for (int i = 0; i < more; ++i)
    world.add_wall({.name = "far", .centre = {100.0 + i, 50, 0.5}, .size = {0.5, 0.5, 1}});
  world.add_robot(kRobot, cart(), {0, 0, 0});
  EXPECT_TRUE(world.set_body_velocity(kRobot, {0.3, 0, 0}));
  for (int i = 0; i < 1000; ++i) world.step();
  return {world.position(kRobot), world.contacts(kRobot).walls.steps};
}

TEST(World, AmongManyWallsTheSameHappensAtOne) {
  const Crash alone = crash(0);
  EXPECT_GT(alone.touches, 100U);
  EXPECT_LT(alone.end.x, 1);
  for (const int more : {10, 62, 63, 500}) {  // 64 are many
    const Crash among = crash(more);
    EXPECT_EQ(among.end, alone.end);
    EXPECT_EQ(among.touches, alone.touches);
  }
}

TEST(World, RobotsInACrowdMeetManyWallsToo) {
  World world(WorldConfig{});
  for (int i = 0; i < 100; ++i)
    world.add_wall({.name = "w", .centre = {2, 2.0 * i, 0.5}, .size = {0.2, 1.8, 1}});
  for (std::uint16_t i = 0; i < 80; ++i) {  // more than Clearance measures
    const hal::AgentId robot{static_cast<std::uint16_t>(i + 1)};
    world.add_robot(robot, cart(), {0, 2.0 * i, 0});
    EXPECT_TRUE(world.set_body_velocity(robot, {0.5, 0, 0}));
  }
  for (int i = 0; i < 600; ++i) world.step();
  for (std::uint16_t i = 1; i <= 80; ++i) {
    EXPECT_GT(world.contacts(hal::AgentId{i}).walls.steps, 10U);
    EXPECT_LT(world.position(hal::AgentId{i}).x, 1.8);
  }
}

}  // namespace
}  // namespace sim::physics
