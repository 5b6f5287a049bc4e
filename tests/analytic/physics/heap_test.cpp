#include "tests/unit/sim/physics/heap.h"

#include <gtest/gtest.h>

namespace sim::physics::test {
namespace {

using hal::node::devices::WheelLevel;

class HeapOfTwenty : public testing::TestWithParam<WheelLevel> {};
INSTANTIATE_TEST_SUITE_P(Levels, HeapOfTwenty, kLevels, level_name);

TEST_P(HeapOfTwenty, StaysUprightForAMinuteAndDissolves) {
  Heap heap(GetParam());
  for (int i = 0; i < 6000; ++i) heap.step(+1);
  EXPECT_GT(heap.world().jammed_steps(), 5000U);
  EXPECT_LE(heap.world().largest_exact_heap(), 8);
  EXPECT_LT(heap.worst_tilt(), 0.3);  // rad
  for (int i = 0; i < 600; ++i) heap.step(-1);
  for (int i = 0; i < Heap::kRobots; ++i) {
    const BodyPose pose = heap.world().pose(Heap::robot(i));
    EXPECT_LT(pose.tilt, 1e-3) << i;  // rad
    EXPECT_GT(hal::math::hypot(pose.position.x, pose.position.y), 2) << i;
  }
}

TEST_P(HeapOfTwenty, RepeatsBitForBit) {
  Heap first(GetParam()), second(GetParam());
  for (int i = 0; i < 1500; ++i) {
    first.step(+1);
    second.step(+1);
  }
  EXPECT_GT(first.world().jammed_steps(), 500U);
  EXPECT_EQ(first.fingerprint(), second.fingerprint());
}

}  // namespace
}  // namespace sim::physics::test
