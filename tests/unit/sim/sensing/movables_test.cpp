// What sensors see of movables, and spheres against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "hal/types/math.h"
#include "hal/types/random.h"
#include "sim/sensing/cone_query.h"
#include "sim/sensing/line_of_sight.h"
#include "sim/sensing/proximity.h"
#include "sim/sensing/scan.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::sensing::test {
namespace {

using hal::AgentId;
using hal::Vec2;
using hal::Vec3;
using hal::math::kPi;
using physics::Movable;
using physics::Shape;
using physics::World;

constexpr double kNever = std::numeric_limits<double>::infinity();

Shape sphere(const Vec3& centre, double radius) {
  Shape shape;
  shape.kind = Shape::Kind::kSphere;
  shape.centre = {centre.x, centre.y};
  shape.radius = radius;
  shape.z_low = centre.z - radius;
  shape.z_high = centre.z + radius;
  return shape;
}

Vec3 any_point(hal::RandomStream& random) {
  return {4 * random.uniform() - 2, 4 * random.uniform() - 2, 2 * random.uniform() - 1};
}

/// Along a ray to a sphere: the smaller root of |o + t d - c|^2 = r^2.
double hit(const Vec3& from, const Vec3& direction, const Vec3& centre, double radius) {
  const Vec3 m = from - centre;
  const double b = hal::dot(m, direction), c = hal::dot(m, m) - radius * radius;
  if (c <= 0) return 0;
  if (b * b < c || b > 0) return kNever;
  return -b - std::sqrt(b * b - c);
}

TEST(Sphere, ScansItAtTheHeightOfTheBeam) {
  hal::RandomStream random(1, "scan");
  const std::array<std::size_t, 1> first{0};
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 from = any_point(random), centre = any_point(random);
    const double radius = 0.1 + random.uniform();
    const Vec2 ahead = unit(2 * kPi * random.uniform());
    const std::array shapes{sphere(centre, radius)};
    const std::array rays{ahead};
    const double range = ray_ranges(from, rays, shapes, first, AgentId{1})[0];
    const double expected = hit(from, {ahead.x, ahead.y, 0}, centre, radius);
    if (expected == kNever) {
      EXPECT_EQ(range, kNever);
      continue;
    }
    ++hits;
    EXPECT_NEAR(range, expected, 1e-9);
  }
  EXPECT_GT(hits, 100);
}

TEST(Sphere, IsNearestAlongTheNearestRayOfASector) {
  hal::RandomStream random(2, "sector");
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 centre = any_point(random);
    const double radius = 0.1 + 0.5 * random.uniform();
    const Sector sector{any_point(random), 2 * kPi * random.uniform(), 0.3, 10};
    double least = kNever;
    for (int ray = 0; ray <= 2000; ++ray) {
      const Vec2 ahead = unit(sector.heading + sector.half_angle * (ray / 1000.0 - 1));
      least = std::min(least, hit(sector.origin, {ahead.x, ahead.y, 0}, centre, radius));
    }
    const auto found = SectorQuery(sector).nearest(sphere(centre, radius));
    if (least == kNever) continue;  // rays may miss it just inside an edge
    ++hits;
    ASSERT_TRUE(found);
    EXPECT_LE(*found, least + 1e-9);
    EXPECT_NEAR(*found, least, 1e-3);  // m; between two rays
  }
  EXPECT_GT(hits, 20);
}

TEST(Sphere, IsNearestAlongTheNearestRayOfACone) {
  hal::RandomStream random(3, "cone");
  int hits = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 centre = any_point(random);
    const double radius = 0.1 + 0.5 * random.uniform(), half = 0.4;
    const Vec2 axis = unit(2 * kPi * random.uniform());
    const Cone cone{any_point(random), axis, unit(half), 10};
    double least = kNever;
    for (int turn = 0; turn < 120; ++turn) {
      const Vec2 around = unit(2 * kPi * turn / 120);
      for (int off = 0; off <= 40; ++off) {
        const Vec2 tilt = unit(half * off / 40);
        const Vec2 level = tilt.x * axis + tilt.y * around.x * Vec2{-axis.y, axis.x};
        least =
            std::min(least, hit(cone.apex, {level.x, level.y, tilt.y * around.y}, centre, radius));
      }
    }
    const auto found = nearest(cone, sphere(centre, radius));
    if (least == kNever) continue;
    ++hits;
    ASSERT_TRUE(found);
    EXPECT_LE(*found, least + 1e-9);
    EXPECT_NEAR(*found, least, 0.03);  // m; between two rays
  }
  EXPECT_GT(hits, 20);
}

TEST(Sphere, HoldsTheChordOfASegment) {
  const Shape ball = sphere({0, 0, 0}, 1);
  EXPECT_DOUBLE_EQ(length_inside(ball, {-5, 0, 0}, {5, 0, 0}), 2);
  EXPECT_NEAR(length_inside(ball, {-5, 0.6, 0}, {5, 0.6, 0}), 1.6, 1e-12);
  EXPECT_NEAR(length_inside(ball, {-5, 0, 0.6}, {5, 0, 0.6}), 1.6, 1e-12);
  EXPECT_DOUBLE_EQ(length_inside(ball, {0, 0, 0}, {0, 0, 3}), 1);  // it begins in the middle
  EXPECT_EQ(length_inside(ball, {-5, 1.1, 0}, {5, 1.1, 0}), 0);
  EXPECT_EQ(length_inside(ball, {2, 0, 0}, {5, 0, 0}), 0);
}

Movable pushed_box(double x) {
  Movable box{.name = "box", .form = physics::MovableBox{{0.3, 0.3, 0.3}}};
  box.pose.x = x;
  return box;
}

std::optional<double> ahead_of(const World& world, const Proximity& proximity, AgentId robot) {
  const Vec3 p = world.position(robot);
  return proximity.nearest(Sector{{p.x, p.y, 0.1}, 0, 0.05, 5}, robot);
}

TEST(Movables, AreSeenWhereTheyAreAfterAPush) {
  World world(physics::WorldConfig{});
  const AgentId robot{1};
  world.add_robot(robot, physics::test::robertino(), {});
  world.add_movable(pushed_box(1));
  world.add_movable(pushed_box(3));  // the next shape, of another body
  Proximity proximity(world);
  EXPECT_NEAR(ahead_of(world, proximity, robot).value(), 0.85, 1e-6);
  ASSERT_TRUE(world.set_body_velocity(robot, {0.5, 0, 0}));
  for (int i = 0; i < 400; ++i) {
    world.step();
    proximity.update();
  }
  EXPECT_GT(world.movable(0).pose.position.x, 1.3);
  EXPECT_NEAR(ahead_of(world, proximity, robot).value(),
              world.movable(0).pose.position.x - 0.15 - world.position(robot).x, 1e-3);
}

TEST(Movables, AreNoWallsForTheLineOfSight) {
  World world(physics::WorldConfig{});
  world.add_movable(pushed_box(1));
  EXPECT_EQ(LineOfSight(world).between({0, 0, 0.1}, {3, 0, 0.1}).walls, 0);
}

}  // namespace
}  // namespace sim::sensing::test
