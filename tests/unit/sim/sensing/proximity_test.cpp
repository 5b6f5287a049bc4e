#include "sim/sensing/proximity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "hal/types/math.h"
#include "hal/types/random.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::sensing::test {
namespace {

using hal::AgentId;
using hal::math::kPi;
using physics::Shape;
using physics::World;
using physics::test::robertino;

/// Every shape of the world through the exact query: what the tree may not change.
std::optional<double> over_all(const World& world, const Sector& sector, AgentId own) {
  std::optional<double> smallest;
  for (const Shape& shape : world.shapes()) {
    if (shape.owner == own) continue;
    const auto d = SectorQuery(sector).nearest(shape);
    if (d && (!smallest || *d < *smallest)) smallest = d;
  }
  return smallest;
}

/// Six robots that wander between ten motes and four walls.
void furnish(World& world, hal::RandomStream& random) {
  const auto place = [&] { return 6 * random.uniform() - 3; };
  for (int i = 0; i < 4; ++i)
    world.add_wall(
        {"wall", {place(), place(), 0.5}, {1.5, 0.1, 1}, 2 * hal::math::kPi * random.uniform()});
  for (std::uint16_t i = 1; i <= 6; ++i)
    world.add_robot(AgentId{i}, physics::test::robertino(), {i - 3.0, 6.0 + place() / 10, 0});
  for (std::uint16_t i = 7; i <= 16; ++i) world.add_mote(AgentId{i}, {}, {place(), place(), 0});
}

void wander(World& world, hal::RandomStream& random) {
  for (std::uint16_t i = 1; i <= 6; ++i) {
    const hal::Twist2 twist{random.uniform() - 0.5, -random.uniform(), random.uniform()};
    EXPECT_TRUE(world.set_body_velocity(AgentId{i}, twist));
  }
  for (int k = 0; k < 10; ++k) world.step();
}

/// @return beams of one robot that met something.
int compare_beams(const World& world, const Proximity& proximity, AgentId robot) {
  const auto pose = world.pose(robot);
  int hits = 0;
  for (int beam = 0; beam < 6; ++beam) {
    const hal::Vec3 origin{pose.position.x, pose.position.y, 0.04};
    const Sector sector{origin, pose.heading + beam * hal::math::kPi / 3, 0.05, 1.5};
    const auto found = proximity.nearest(sector, robot);
    EXPECT_EQ(found, over_all(world, sector, robot));
    hits += found ? 1 : 0;
  }
  return hits;
}

TEST(Proximity, FindsWhatASearchOverAllShapesFindsWhileBodiesMove) {
  World world(physics::WorldConfig{});
  hal::RandomStream random(3, "scene");
  furnish(world, random);
  Proximity proximity(world);
  int hits = 0;
  for (int tick = 0; tick < 120; ++tick) {
    wander(world, random);
    if (tick % 7 == 3) continue;  // then it is two ticks behind, else one
    proximity.update();
    for (std::uint16_t i = 1; i <= 6; ++i) hits += compare_beams(world, proximity, AgentId{i});
  }
  EXPECT_GT(hits, 400);
}

TEST(Proximity, OwnBodyIsTransparentAndOthersAreNot) {
  World world(physics::WorldConfig{});
  world.add_robot(AgentId{1}, physics::test::robertino(), {});
  world.add_robot(AgentId{2}, physics::test::robertino(), {1, 0, 0});
  const Proximity proximity(world);
  const Sector ahead{{0.185, 0, 0.04}, 0, 0.04, 2};
  EXPECT_NEAR(*proximity.nearest(ahead, AgentId{1}), 1 - 2 * 0.185, 1e-12);
  EXPECT_EQ(proximity.nearest(ahead, AgentId{3}), 0.0);  // on the rim of robot 1
  EXPECT_NEAR(*proximity.nearest(ahead, AgentId{2}), 0.0, 0.0);
}

TEST(Proximity, MovesAreSeenAfterAnUpdate) {
  World world(physics::WorldConfig{});
  world.add_robot(AgentId{1}, physics::test::robertino(), {5, 0, 0});
  Proximity proximity(world);
  ASSERT_TRUE(world.set_body_velocity(AgentId{1}, {-0.9, 0, 0}));
  for (int i = 0; i < 500; ++i) world.step();
  proximity.update();
  const Sector ahead{{0, 0, 0.04}, 0, 0.04, 3};
  const double expected = world.pose(AgentId{1}).position.x - 0.185;
  ASSERT_LT(expected, 3);
  EXPECT_NEAR(*proximity.nearest(ahead, AgentId{2}), expected, 2e-5);  // m: the body leans 1e-4 rad
}

TEST(Proximity, EmptyWorldIsEmpty) {
  const World world(physics::WorldConfig{});
  Proximity proximity(world);
  proximity.update();
  EXPECT_FALSE(proximity.nearest({{0, 0, 0.04}, 0, 0.04, 3}, AgentId{1}));
}

}  // namespace
}  // namespace sim::sensing::test
