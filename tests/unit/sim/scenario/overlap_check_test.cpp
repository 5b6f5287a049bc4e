#include "sim/scenario/overlap_check.h"

#include <gtest/gtest.h>

#include <string>

namespace sim::scenario {
namespace {

using Lines = std::vector<std::string>;

const hal::node::devices::MoteDescription kCube{.model = "mote", .size = {0.1, 0.1, 0.1}};

/// Motes at poses, by address from 1, all of a group "motes".
Scenario motes_at(const std::vector<hal::Pose2>& poses) {
  Scenario scenario;
  Group group;
  group.name = "motes";
  for (const hal::Pose2& pose : poses) {
    const auto number = static_cast<std::uint16_t>(group.agents.size() + 1);
    group.agents.push_back(hal::AgentId{number});
    group.places.push_back("a.yaml:" + std::to_string(number) + ":1");
    scenario.simulation.agents.push_back({.id = group.agents.back(),
                                          .name = "m" + std::to_string(number),
                                          .pose = pose,
                                          .body = kCube,
                                          .program = {},
                                          .parameters = {}});
  }
  scenario.groups.push_back(group);
  return scenario;
}

TEST(OverlapCheck, LetsBodiesTouch) {
  EXPECT_EQ(overlaps(motes_at({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {-0.1, 0, 0}})), Lines{});
  // As far as contacts rest in each other, and no farther.
  EXPECT_EQ(overlaps(motes_at({{0, 0, 0}, {0.09995, 0, 0}})), Lines{});
  EXPECT_EQ(overlaps(motes_at({{0, 0, 0}, {0.0998, 0, 0}})).size(), 1u);
}

TEST(OverlapCheck, NamesBothTheirDepthAndTheirDistanceAtThePlaceOfTheLaterOne) {
  EXPECT_EQ(overlaps(motes_at({{5, 0, 0}, {0, 0, 0}, {0.08, 0.06, 0}})),
            Lines{"a.yaml:3:1: agents.motes: at the start m3 overlaps m2 by 0.02 m; they are 0.1 m "
                  "apart"});
}

TEST(OverlapCheck, SeesTurnedBoxesAsTheyAre) {
  // 0.13 m apart: squares do not meet, one that stands on its corner would if it were a circle.
  constexpr double kQuarter = 0.785398163397448;
  EXPECT_EQ(overlaps(motes_at({{0, 0, 0}, {0.13, 0, kQuarter}})), Lines{});
  EXPECT_EQ(overlaps(motes_at({{0, 0, 0}, {0.11, 0, kQuarter}})).size(), 1u);
}

TEST(OverlapCheck, LetsWallsOverlapOneAnother) {
  Scenario scenario = motes_at({{0, 0, 0}});
  scenario.simulation.walls = {{"a", {3, 0, 0.5}, {1, 1, 1}}, {"b", {3.2, 0, 0.5}, {1, 1, 1}}};
  EXPECT_EQ(overlaps(scenario), Lines{});
  scenario.simulation.walls.push_back({"c", {0.1, 0, 0.5}, {0.12, 9, 1}});
  EXPECT_EQ(overlaps(scenario),
            Lines{"a.yaml:1:1: agents.motes: at the start m1 is 0.01 m deep in 'c'"});
}

TEST(OverlapCheck, OfManyAtOnePointNamesAFewAndCountsTheRest) {
  const Lines lines = overlaps(motes_at(std::vector<hal::Pose2>(5000)));
  ASSERT_EQ(lines.size(), kMostLines + 1);
  EXPECT_EQ(lines[0],
            "a.yaml:2:1: agents.motes: at the start m2 overlaps m1 by 0.1 m; they are 0 m apart");
  EXPECT_EQ(lines.back(), "a.yaml:22:1: agents.motes: and so do 4979 more agents");
}

TEST(OverlapCheck, FindsTheOneAmongThousands) {
  std::vector<hal::Pose2> poses;
  for (int i = 0; i < 4000; ++i) poses.push_back({0.2 * (i % 63), 0.2 * (i / 63), 0});
  EXPECT_EQ(overlaps(motes_at(poses)), Lines{});
  poses[3000] = {poses[17].x + 0.05, poses[17].y, 0};
  EXPECT_EQ(
      overlaps(motes_at(poses)),
      Lines{"a.yaml:3001:1: agents.motes: at the start m3001 overlaps m18 by 0.05 m; they are "
            "0.05 m apart"});
}

}  // namespace
}  // namespace sim::scenario
