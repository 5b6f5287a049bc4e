#include "controllers/bridge_robot/gaps.h"

#include <gtest/gtest.h>

#include "controllers/gap_message.h"

namespace controllers {
namespace {

using hal::AgentId;

constexpr double kReach = 50;  // m

/// In a line, 40 m apart: 1 is the sink, 3 has failed, 4 to 6 call. 9 is a robot among them.
const std::vector<Seen> kLine = {
    {AgentId{1}, {0, 0}},   {AgentId{2}, {40, 0}},  {AgentId{3}, {80, 0}},  {AgentId{4}, {120, 0}},
    {AgentId{5}, {160, 0}}, {AgentId{6}, {200, 0}}, {AgentId{9}, {115, 30}}};

TEST(Gaps, AreBridgedHalfwayToTheNearestThatNeitherCallsNorHasFailed) {
  const auto gaps =
      find_gaps(kLine, {{AgentId{4}, 30}, {AgentId{5}, 30}, {AgentId{6}, 15}}, kReach);
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_EQ(gaps[0].island, AgentId{4});
  EXPECT_EQ(gaps[0].near, AgentId{4});
  EXPECT_EQ(gaps[0].far, AgentId{2});
  EXPECT_EQ(gaps[0].place, (hal::Vec2{80, 0}));
  EXPECT_EQ(gaps[0].need, 75);
}

TEST(Gaps, ThatAreTooWideForOneRobotAreLeftOut) {
  EXPECT_TRUE(find_gaps(kLine, {{AgentId{4}, 30}}, 15).empty());  // 2 * 15 < 30.4
  EXPECT_TRUE(find_gaps({{AgentId{4}, {0, 0}}}, {{AgentId{4}, 30}}, kReach).empty());
  EXPECT_TRUE(find_gaps(kLine, {}, kReach).empty());
}

TEST(Gaps, OfSeveralIslandsAreOneEach) {
  std::vector<Seen> two = kLine;
  two.push_back({AgentId{7}, {0, 80}});
  two.push_back({AgentId{8}, {0, 120}});
  const auto gaps = find_gaps(
      two, {{AgentId{4}, 30}, {AgentId{5}, 30}, {AgentId{6}, 30}, {AgentId{7}, 1}, {AgentId{8}, 1}},
      kReach);
  ASSERT_EQ(gaps.size(), 2u);
  EXPECT_EQ(gaps[0].island, AgentId{4});
  EXPECT_EQ(gaps[1].island, AgentId{7});
  EXPECT_EQ(gaps[1].need, 2);
  EXPECT_EQ(gaps[1].place, (hal::Vec2{0, 40}));
}

/// What 20 m with 50 kJ are worth.
double worth_of(const Weights& weights, double need = 30, double distance = 20,
                double energy = 50e3) {
  return worth({.island = AgentId{4}, .need = need}, distance, energy, weights);
}

TEST(Worth, GrowsWithNeedAndEnergyAndFallsWithDistance) {
  const Weights weights{.drive_cost = 100};
  EXPECT_DOUBLE_EQ(worth_of(weights), 30 * (50e3 - 2e3) / 21);
  EXPECT_GT(worth_of(weights, 60), worth_of(weights, 30));
  EXPECT_GT(worth_of(weights, 30, 10), worth_of(weights, 30, 20));
  EXPECT_GT(worth_of(weights, 30, 20, 60e3), worth_of(weights, 30, 20));
  // A greater need may be worth a longer way, unless distance counts more.
  EXPECT_GT(worth_of(weights, 90, 40), worth_of(weights, 30, 20));
  EXPECT_LT(worth_of({.distance = 3}, 90, 40), worth_of({.distance = 3}, 30, 20));
}

TEST(Worth, IsNothingIfTheBatteryDoesNotLast) {
  const Weights weights{.drive_cost = 1000, .reserve = 10e3};
  EXPECT_GT(worth_of(weights, 30, 20, 31e3), 0);
  EXPECT_EQ(worth_of(weights, 30, 20, 30e3), 0);
  EXPECT_EQ(worth_of({.energy = 0, .drive_cost = 1000}, 30, 60, 50e3), 0);
}

TEST(GapMessages, AreReadAsTheyWereWritten) {
  const GapMessage bid{GapWord::kBid, AgentId{515}, 0.1};
  EXPECT_EQ(decode_gap(encode(bid)), bid);
  EXPECT_EQ(decode_gap(std::vector<std::uint8_t>(kGapMessageSize, 0)), std::nullopt);
  EXPECT_EQ(decode_gap(std::vector<std::uint8_t>(3, 1)), std::nullopt);
}

}  // namespace
}  // namespace controllers
