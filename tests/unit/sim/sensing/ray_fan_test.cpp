#include "sim/sensing/ray_fan.h"

#include <gtest/gtest.h>

#include <limits>

#include "hal/types/math.h"
#include "hal/types/random.h"
#include "sim/physics/world.h"
#include "sim/sensing/proximity.h"
#include "sim/sensing/scan.h"

namespace sim::sensing {
namespace {

constexpr double kReach = 6;  // m

/// A yard of 20 m with walls at all angles and motes.
std::unique_ptr<physics::World> yard(int walls, hal::RandomStream& random) {
  auto world = std::make_unique<physics::World>(physics::WorldConfig{});
  for (int i = 0; i < walls; ++i) {
    world->add_wall({.name = "w",
                     .centre = {20 * random.uniform(), 20 * random.uniform(), random.uniform()},
                     .size = {0.1 + 3 * random.uniform() * random.uniform(),
                              0.05 + 0.3 * random.uniform(), 0.2 + random.uniform()},
                     .yaw = 6.3 * random.uniform()});
  }
  for (std::uint16_t i = 1; i < 8; ++i) {
    const hal::node::devices::MoteDescription mote{
        .model = "box", .size = {0.2 + random.uniform(), 0.3, 0.9}, .mass = 1};
    world->add_mote(hal::AgentId{i}, mote, {20 * random.uniform(), 20 * random.uniform(), 1.0 * i});
  }
  return world;
}

/// Ranges beyond the reach are all the same to a scanner.
std::vector<double> within_reach(std::vector<double> ranges) {
  for (double& range : ranges)
    if (range > kReach) range = std::numeric_limits<double>::infinity();
  return ranges;
}

void compare(int walls, const std::vector<double>& headings, std::uint64_t seed) {
  hal::RandomStream random(seed, "yard");
  const auto world = yard(walls, random);
  const Proximity proximity(*world);
  RayFan fan(headings, kReach);
  std::vector<std::size_t> all(world->shapes().size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  std::size_t hits = 0;
  for (int k = 0; k < 200; ++k) {
    const hal::AgentId own{static_cast<std::uint16_t>(k % 9)};  // 0: nobody
    const hal::Vec3 origin{20 * random.uniform(), 20 * random.uniform(), random.uniform()};
    const hal::Vec2 ahead = unit(6.3 * random.uniform());
    std::vector<hal::Vec2> directions;
    for (const double heading : headings) directions.push_back(turned(unit(heading), ahead));
    const auto expected = within_reach(ray_ranges(origin, directions, world->shapes(), all, own));
    EXPECT_EQ(within_reach(fan.ranges(origin, ahead, proximity, world->shapes(), own)), expected);
    for (const double range : expected) hits += range <= kReach ? 1 : 0;
  }
  EXPECT_GT(hits, headings.size());
}

std::vector<double> circle(int rays, double from) {
  std::vector<double> headings;
  for (int i = 0; i < rays; ++i) headings.push_back(from + 2 * hal::math::kPi * i / rays);
  return headings;
}

TEST(RayFan, MeasuresWhatEveryRayAgainstEveryShapeDoes) {
  for (const int walls : {0, 3, 20, 63, 64, 400}) {
    if (walls > 0) compare(walls, circle(360, 0), 1);
    if (walls > 0) compare(walls, circle(360, -hal::math::kPi), 2);
  }
}

TEST(RayFan, MayBeNarrowOrHaveOneRayOrRaysInAnyOrder) {
  for (const int walls : {50, 300}) {
    compare(walls, {0.3}, 3);
    compare(walls, {0.1, -0.2, 0.25, 3.1, -3.1, 0.1}, 4);
    std::vector<double> narrow;
    for (int i = 0; i < 500; ++i) narrow.push_back(1e-4 * (i - 250));
    compare(walls, narrow, 5);
  }
}

TEST(RayFan, FromInsideAWallEverythingIsAtZero) {
  for (const int more : {0, 100}) {
    physics::World world(physics::WorldConfig{});
    world.add_wall({.name = "thick", .centre = {0, 0, 0.5}, .size = {2, 2, 1}});
    for (int i = 0; i < more; ++i)
      world.add_wall({.name = "far", .centre = {5.0 + i, 0, 0.5}, .size = {0.5, 0.5, 1}});
    const Proximity proximity(world);
    RayFan fan(circle(90, 0), kReach);
    for (const double range : fan.ranges({0.3, 0.2, 0.5}, {1, 0}, proximity, world.shapes(), {}))
      EXPECT_EQ(range, 0);
  }
}

}  // namespace
}  // namespace sim::sensing
