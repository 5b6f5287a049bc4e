#include "hal/robot/agent/localisation.h"

#include <gtest/gtest.h>

#include <vector>

#include "hal/types/math.h"

namespace hal::robot::agent {
namespace {

TEST(RelativePositions, AreInTheBodyFrameByAddressWithinRangeAndWithoutOneself) {
  const std::vector<Landmark> map{{AgentId{1}, "m0", {3, 2}},
                                  {AgentId{2}, "m1", {1, 5}},
                                  {AgentId{7}, "self", {1, 2}},
                                  {AgentId{9}, "far", {1, 12.5}}};
  const auto triples = relative_positions({1, 2, math::kPi / 2}, AgentId{7}, map, 10);
  ASSERT_EQ(triples.size(), 6U);
  EXPECT_EQ(triples[0], 1);
  EXPECT_NEAR(triples[1], 0, 1e-12);   // 2 m east of a robot that looks north:
  EXPECT_NEAR(triples[2], -2, 1e-12);  // to its right
  EXPECT_EQ(triples[3], 2);
  EXPECT_NEAR(triples[4], 3, 1e-12);
  EXPECT_NEAR(triples[5], 0, 1e-12);
}

}  // namespace
}  // namespace hal::robot::agent
