#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/physics/world.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::physics::test {
namespace {

using hal::node::devices::WheelLevel;

constexpr AgentId kMoved{1}, kOther{2};

class Placed : public testing::TestWithParam<WheelLevel> {
 protected:
  Placed() { world.add_robot(kMoved, robertino(GetParam()), {0, 0, 0}); }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) world.step();
  }
  World world{WorldConfig{}};
};

TEST_P(Placed, ARobotIsThereWithTheNextStepUprightAndAtRest) {
  run(100);
  world.place(kMoved, {5, -7, 2});
  EXPECT_NEAR(world.position(kMoved).x, 0, 1e-3);  // not before
  run(1);
  const BodyPose pose = world.pose(kMoved);
  EXPECT_NEAR(pose.position.x, 5, 1e-3);
  EXPECT_NEAR(pose.position.y, -7, 1e-3);
  EXPECT_NEAR(pose.heading, 2, 1e-3);
  EXPECT_LT(pose.tilt, 1e-2);
  EXPECT_EQ(world.moved_at(kMoved), world.steps());
  run(100);
  EXPECT_NEAR(world.position(kMoved).x, 5, 0.01);
  EXPECT_NEAR(world.position(kMoved).z, 0, 0.01);
  EXPECT_TRUE(world.lost_bodies().empty());
}

TEST_P(Placed, ARobotKeepsItsCommandAndDrivesWhereItNowLooks) {
  (void)world.set_body_velocity(kMoved, {0.5, 0, 0});
  run(200);
  world.place(kMoved, {0, 10, M_PI / 2});
  run(200);
  EXPECT_NEAR(world.position(kMoved).x, 0, 0.1);
  EXPECT_GT(world.position(kMoved).y, 10.5);
}

TEST_P(Placed, OneThatSleepsIsMovedAndOneThatIsMetThereIsFound) {
  world.add_mote(kOther, {}, {20, 0, 0});
  run(1000);
  ASSERT_TRUE(world.asleep(kOther));
  world.place(kOther, {30, 5, 0});
  world.place(kMoved, {29, 5, 0});
  run(1);
  EXPECT_NEAR(world.position(kOther).x, 30, 1e-3);
  run(1000);
  (void)world.set_body_velocity(kMoved, {0.5, 0, 0});
  run(400);
  EXPECT_GT(world.position(kOther).x, 30.2);  // pushed along
  EXPECT_GT(world.contacts(kMoved).motes.steps, 0u);
}

INSTANTIATE_TEST_SUITE_P(Levels, Placed,
                         testing::Values(WheelLevel::kJointed, WheelLevel::kContact));

}  // namespace
}  // namespace sim::physics::test
