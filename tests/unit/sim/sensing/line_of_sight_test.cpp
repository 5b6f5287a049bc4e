#include "sim/sensing/line_of_sight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hal/types/math.h"
#include "hal/types/random.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::sensing::test {
namespace {

using hal::Vec3;
using hal::math::kPi;
using physics::World;

constexpr double kRounding = 1e-12;

/// One wall, 0.3 m thick along x, 20 m long, 1 m high, in the origin.
World& walled(World& world) {
  world.add_wall({"wall", {0, 0, 0.5}, {0.3, 20, 1}, 0});
  return world;
}

TEST(LineOfSight, ThicknessIsTheWayInsideTheWall) {
  World world(physics::WorldConfig{});
  const LineOfSight sight(walled(world));
  const Crossing straight = sight.between({-5, 0, 0.4}, {5, 0, 0.4});
  EXPECT_EQ(straight.walls, 1);
  EXPECT_NEAR(straight.thickness, 0.3, kRounding);
  const Crossing oblique = sight.between({-5, -5, 0.4}, {5, 5, 0.4});
  EXPECT_NEAR(oblique.thickness, 0.3 * std::sqrt(2.0), kRounding);
  const Crossing ends_inside = sight.between({-5, 0, 0.4}, {0, 0, 0.4});
  EXPECT_EQ(ends_inside.walls, 1);
  EXPECT_NEAR(ends_inside.thickness, 0.15, kRounding);
}

TEST(LineOfSight, LinesBesideAboveAndAlongAreFree) {
  World world(physics::WorldConfig{});
  const LineOfSight sight(walled(world));
  EXPECT_EQ(sight.between({-5, 10.01, 0.4}, {5, 10.01, 0.4}).walls, 0);
  EXPECT_EQ(sight.between({-5, 0, 1.01}, {5, 0, 1.01}).walls, 0);
  EXPECT_EQ(sight.between({-5, 0, 1}, {5, 0, 1}).walls, 0);  // grazes the top
  EXPECT_EQ(sight.between({-5, 0, 0.4}, {-0.2, 0, 0.4}).walls, 0);
  EXPECT_EQ(sight.between({1, 1, 1}, {1, 1, 1}).walls, 0);
}

TEST(LineOfSight, SlopingLineCrossesOnlyBelowTheTop) {
  // Falls from z = 2 at x = -1 to z = 0 at x = 1: at x = 0 it is at the top, 1 m.
  World world(physics::WorldConfig{});
  const LineOfSight sight(walled(world));
  const Crossing crossing = sight.between({-1, 0, 2}, {1, 0, 0});
  EXPECT_EQ(crossing.walls, 1);
  EXPECT_NEAR(crossing.thickness, 0.15 * std::sqrt(2.0), kRounding);
  EXPECT_NEAR(sight.between({0, 0, 5}, {0, 0, 0}).thickness, 1, kRounding);  // straight down
}

TEST(LineOfSight, WallsAddUpAndBodiesDoNotCount) {
  World world(physics::WorldConfig{});
  walled(world);
  world.add_wall({"second", {2, 0, 0.5}, {0.2, 20, 1}, 0});
  world.add_wall({"aside", {2, 50, 0.5}, {0.2, 20, 1}, 0});
  world.add_robot(hal::AgentId{1}, physics::test::robertino(), {1, 0, 0});
  const LineOfSight sight(world);
  const Crossing crossing = sight.between({-5, 0, 0.1}, {5, 0, 0.1});
  EXPECT_EQ(crossing.walls, 2);
  EXPECT_NEAR(crossing.thickness, 0.5, kRounding);
}

TEST(LineOfSight, AgreesWithPointsSampledAlongTheLine) {
  World world(physics::WorldConfig{});
  hal::RandomStream random(5, "walls");
  const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  for (int i = 0; i < 12; ++i)
    world.add_wall({"w",
                    {between(-8, 8), between(-8, 8), 0.5},
                    {between(1, 6), between(0.1, 1), 1},
                    between(-hal::math::kPi, hal::math::kPi)});
  const LineOfSight sight(world);
  for (int k = 0; k < 40; ++k) {
    const Vec3 from{between(-9, 9), between(-9, 9), between(0, 1.5)};
    const Vec3 to{between(-9, 9), between(-9, 9), between(0, 1.5)};
    constexpr int kSamples = 2000;
    int hits = 0;
    for (int s = 0; s < kSamples; ++s) {
      const Vec3 p = from + ((s + 0.5) / kSamples) * (to - from);
      for (const physics::Shape& w : world.shapes()) {
        const hal::Vec2 d{p.x - w.centre.x, p.y - w.centre.y};
        hits += std::abs(hal::dot(d, w.axis)) < w.half.x && p.z < 1 &&
                std::abs(w.axis.x * d.y - w.axis.y * d.x) < w.half.y;
      }
    }
    const Vec3 way = to - from;
    const double length = std::sqrt(hal::dot(way, way));
    // m: a sample stands for length / 2000; every wall can be off by one sample.
    EXPECT_NEAR(sight.between(from, to).thickness, hits * length / kSamples,
                13 * length / kSamples);
  }
}

}  // namespace
}  // namespace sim::sensing::test
