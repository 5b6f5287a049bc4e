#include <gtest/gtest.h>

#include <vector>

#include "sim/agents/surroundings.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::agents {
namespace {

using hal::AgentId;

constexpr AgentId kRobot{1}, kMote{2};

void expect_seen_as_it_is(Scene& scene, const physics::World& world, AgentId agent) {
  const physics::BodyPose pose = world.pose(agent);
  const BodyState& seen = scene.body(agent, world.now());
  EXPECT_EQ(seen.x, pose.position.x);
  EXPECT_EQ(seen.y, pose.position.y);
  EXPECT_EQ(seen.theta, pose.heading);
  EXPECT_EQ(seen.tilt, pose.tilt);
  EXPECT_NEAR(seen.clearance, 4.9 - pose.position.x, 1e-9);  // m, to the wall's surface
}

// What is kept of a body that rests must not be kept when it is pushed.
TEST(Scene, SeesABodyThatRestedAndThenIsPushed) {
  physics::World world(physics::WorldConfig{});
  world.add_wall({.name = "east", .centre = {5, 0, 0.5}, .size = {0.2, 100, 1}});
  world.add_robot(kRobot, physics::test::robertino(), {-1, 0, 0});
  world.add_mote(kMote, {}, {0, 0, 0.3});
  Scene scene(world, {kRobot, kMote});
  expect_seen_as_it_is(scene, world, kMote);
  for (int i = 0; i < 400; ++i) {
    if (i == 100) (void)world.set_body_velocity(kRobot, {0.5, 0, 0});
    world.step();
    // The mote is looked at now and then only, as at control instants.
    expect_seen_as_it_is(scene, world, kRobot);
    if (i % 7 == 0) expect_seen_as_it_is(scene, world, kMote);
  }
  EXPECT_GT(scene.body(kMote, world.now()).x, 0.1) << "it was pushed";
}

}  // namespace
}  // namespace sim::agents
