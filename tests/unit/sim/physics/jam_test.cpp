#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <vector>

#include "hal/types/math.h"
#include "sim/core/fingerprint.h"
#include "sim/physics/contact_islands.h"
#include "sim/physics/world.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::physics::test {
namespace {

using hal::math::kPi;

constexpr std::uint16_t kHeap = 7;
constexpr AgentId kLoner{100};

void add_hash(Hash& hash, const BodyPose& pose) {
  for (const double v : {pose.position.x, pose.position.y, pose.position.z}) hash.add(v);
  for (const double v : pose.quaternion) hash.add(v);
}

/// Robots on a circle that all drive to its middle, where one stands, with motes in their way.
void add_heap(World& world) {
  world.add_robot(AgentId{kHeap + 1}, robertino(), {0.01, 0.02, 0});
  for (std::uint16_t i = 0; i < kHeap; ++i) {
    const double angle = 2 * hal::math::kPi * i / kHeap;
    const hal::Pose2 pose{hal::math::cos(angle), hal::math::sin(angle), angle + hal::math::kPi};
    world.add_robot(AgentId{static_cast<std::uint16_t>(i + 1)}, robertino(), pose);
  }
  for (std::uint16_t i = 0; i < 3; ++i)
    world.add_mote(AgentId{static_cast<std::uint16_t>(i + 20)}, {}, {0.45, 0.1 * i - 0.1, 0.3});
}

void drive_heap(World& world) {
  for (std::uint16_t i = 1; i <= kHeap; ++i)
    EXPECT_TRUE(world.set_body_velocity(AgentId{i}, {0.6, 0, 0}));
}

std::uint64_t hash_of(const World& world) {
  Hash hash;
  for (std::uint16_t i = 1; i < 30; ++i)
    if (world.has(AgentId{i})) add_hash(hash, world.pose(AgentId{i}));
  return hash.value();
}

void expect_sound(const World& world, AgentId robot) {
  const BodyPose pose = world.pose(robot);
  EXPECT_TRUE(std::isfinite(pose.position.x) && std::isfinite(pose.heading));
  // 4e-3 rad was measured in such heaps; a robot that climbs another tilts by tenths.
  EXPECT_LT(pose.tilt, 0.05);
  EXPECT_LT(hal::math::hypot(pose.position.x, pose.position.y), 2);
  EXPECT_GT(world.contacts(robot).robots.steps, 0U);
}

TEST(Jam, HeapOfRobotsStaysFiniteAndUpright) {
  World world(WorldConfig{});
  add_heap(world);
  drive_heap(world);
  for (int i = 0; i < 500; ++i) world.step();
  EXPECT_GT(world.jammed_steps(), 100U);
  for (std::uint16_t i = 1; i <= kHeap; ++i) expect_sound(world, AgentId{i});
}

TEST(Jam, EqualRunsGiveEqualBits) {
  std::vector<std::uint64_t> hashes;
  for (int k = 0; k < 2; ++k) {
    World world(WorldConfig{});
    add_heap(world);
    drive_heap(world);
    for (int i = 0; i < 300; ++i) world.step();
    EXPECT_GT(world.jammed_steps(), 0U);
    hashes.push_back(hash_of(world));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Jam, AnotherWorldInTheProcessChangesNothing) {
  World alone(WorldConfig{});
  World beside(WorldConfig{});
  World other(WorldConfig{.seed = 9});
  for (World* world : {&alone, &beside, &other}) {
    add_heap(*world);
    drive_heap(*world);
  }
  for (int i = 0; i < 300; ++i) alone.step();
  for (int i = 0; i < 300; ++i) {
    other.step();
    beside.step();
  }
  EXPECT_EQ(hash_of(alone), hash_of(beside));
  EXPECT_NE(hash_of(alone), hash_of(other));  // the seed reaches the solver
}

TEST(Jam, RobotElsewhereMovesBitForBitAsWithoutTheJam) {
  World with(WorldConfig{});
  World without(WorldConfig{});
  for (World* world : {&with, &without}) {
    world->add_robot(kLoner, robertino(), {50, 0, 0});
    ASSERT_TRUE(world->set_body_velocity(kLoner, {0.3, 0.2, 0.5}));
  }
  add_heap(with);
  drive_heap(with);
  for (int i = 0; i < 300; ++i) {
    with.step();
    without.step();
  }
  EXPECT_GT(with.jammed_steps(), 0U);
  Hash a, b;
  add_hash(a, with.pose(kLoner));
  add_hash(b, without.pose(kLoner));
  EXPECT_EQ(a.value(), b.value());
}

TEST(Jam, RingWithFewContactsButManyRobotsIsAJam) {
  for (const int limit : {4, 5}) {
    World world(WorldConfig{.jam_robots = limit});
    for (std::uint16_t i = 0; i < 5; ++i)  // a chain: four contacts
      world.add_robot(AgentId{static_cast<std::uint16_t>(i + 1)}, robertino(), {0.3699 * i, 0, 0});
    world.step();
    EXPECT_EQ(world.jammed_steps(), limit == 4 ? 1U : 0U);
  }
}

TEST(Jam, BodiesOfAJamMoveOncePerStep) {
  // Four motes that fall face to face: twelve contacts, and nothing but gravity acts on them.
  World world(WorldConfig{});
  for (std::uint16_t i = 0; i < 4; ++i)
    world.add_mote(AgentId{static_cast<std::uint16_t>(i + 1)}, {}, {}, 2 + 0.04995 * i);
  for (int i = 0; i < 10; ++i) world.step();
  EXPECT_EQ(world.jammed_steps(), 10U);
  // m: g dt^2 n (n + 1) / 2; contacts give at most 0.1 m/s for 0.1 s. Stepped twice: 0.2 m.
  EXPECT_NEAR(2 - world.pose(AgentId{1}).position.z, 9.81 * 1e-4 * 55, 0.01);
}

TEST(ContactIslands, CountOfAGroupIsTheSumOverItsMembers) {
  ContactIslands islands;
  for (int i = 0; i < 6; ++i) islands.add_object(i >= 4);
  islands.join(4, 1, 3);
  islands.add(4, 2);
  islands.join(1, 5, 4);
  islands.join(4, 5, 1);  // closes a ring
  islands.add(0, 7);
  for (const std::size_t member : {1U, 4U, 5U})
    EXPECT_EQ(islands.total(member).contacts, 10) << member;
  for (const std::size_t member : {1U, 4U, 5U})
    EXPECT_EQ(islands.total(member).robots, 2) << member;
  EXPECT_EQ(islands.total(0).contacts, 7);
  EXPECT_EQ(islands.total(2).contacts, 0);
  islands.reset();
  EXPECT_TRUE(islands.empty());
  EXPECT_EQ(islands.total(4).contacts, 0);
  EXPECT_EQ(islands.total(4).robots, 1);
  EXPECT_EQ(islands.total(1).robots, 0);
}

}  // namespace
}  // namespace sim::physics::test
