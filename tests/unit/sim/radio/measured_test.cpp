// Losses of links as measured, on the air.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "sim/radio/channel/measured.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

MeasuredConfig measured(std::vector<MeasuredRow> rows, bool has_times) {
  MeasuredConfig config;
  config.rows = std::make_shared<const std::vector<MeasuredRow>>(std::move(rows));
  config.has_times = has_times;
  return config;
}

/// RSSI at each receiver of broadcasts by each station in turn, 100 ms apart; dBm by (from, to).
std::map<std::pair<int, int>, double> levels_of(const MeasuredConfig& law, int stations = 3) {
  Air air(Profile::kIeee80211b);
  waves_of(air.config)->propagation.chain = {law};
  air.add_line(stations, 10);
  air.build();
  for (std::uint16_t i = 1; i <= stations; ++i)
    air.at(i * 100ms, [&air, i] { air.broadcast(i, 100); });
  air.run(10s);
  std::map<std::pair<int, int>, double> found;
  for (const auto& one : air.log.receptions)
    found[{static_cast<int>(one.frame >> 48), one.receiver.value}] = one.rssi_dbm;
  return found;
}

TEST(Measured, GivesEachLinkItsLossAndTheOtherDirectionThatOfTheFirst) {
  const auto found =
      levels_of(measured({{"s1", "s2", 0, 70}, {"s2", "s1", 0, 75}, {"s1", "s3", 0, 60}}, false));
  EXPECT_EQ(found.size(), 4u) << "nothing arrives between s2 and s3";
  EXPECT_NEAR(found.at({1, 2}), 16.0206 - 70, 1e-3);
  EXPECT_NEAR(found.at({2, 1}), 16.0206 - 75, 1e-3);
  EXPECT_NEAR(found.at({1, 3}), 16.0206 - 60, 1e-3);
  EXPECT_NEAR(found.at({3, 1}), 16.0206 - 60, 1e-3);
}

TEST(Measured, LeavesLinksWithoutRowsToAnotherLaw) {
  auto law = measured({{"s1", "s2", 0, 70}}, false);
  law.otherwise = LogDistanceConfig{};
  const auto found = levels_of(law);
  EXPECT_NEAR(found.at({2, 1}), 16.0206 - 70, 1e-3);
  EXPECT_NEAR(found.at({2, 3}), 16.0206 - 46.6777 - 30, 1e-3);  // 10 m
}

TEST(Measured, LetsNothingArriveFromWhereNoStationIs) {
  auto law = measured({{"s1", "s2", 0, 70}}, false);
  law.stations = {{hal::AgentId{1}, "s1"}, {hal::AgentId{2}, "s2"}};
  const PropagationConfig air;
  const Site jammer({5, 0, 0}), station({0, 0, 0}, 0, 0, hal::AgentId{1});
  const auto left = [&] {
    return make(law, air, *kFlatGround)->after(hal::Milliwatts{1}, Path(jammer, station)).value;
  };
  EXPECT_EQ(left(), 0);
  law.otherwise = FriisConfig{};
  EXPECT_GT(left(), 0);
}

/// RSSI at station 2 of broadcasts 100 ms apart.
std::vector<double> trace_levels(const MeasuredConfig& law) {
  Air air(Profile::kIeee80211b);
  waves_of(air.config)->propagation.chain = {law};
  air.add_line(2, 10);
  air.build();
  for (int i = 0; i < 6; ++i) air.at(i * 100ms, [&air] { air.broadcast(1, 100); });
  air.run(10s);
  std::vector<double> found;
  for (const auto& one : air.log.receptions)
    if (one.verdict == hal::Verdict::kDelivered) found.push_back(one.rssi_dbm - 16.0206);
  return found;
}

// Rows at 0.15 s and 0.35 s; stations stand still.
TEST(Measured, PlaysATraceWhileNobodyMoves) {
  auto law = measured({{"s1", "s2", 0.35, 80}, {"s1", "s2", 0.15, 60}}, true);
  const auto held = trace_levels(law);
  ASSERT_EQ(held.size(), 6u);
  const std::vector<double> steps{-60, -60, -60, -60, -80, -80};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(held[i], steps[i], 1e-3) << i;
  law.between = MeasuredBetween::kLinear;
  const auto linear = trace_levels(law);
  ASSERT_EQ(linear.size(), 6u);
  const std::vector<double> ramp{-60, -60, -65, -75, -80, -80};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(linear[i], ramp[i], 1e-3) << i;
}

TEST(Measured, DoesNotReachWhereTheTraceIsBelowTheSensitivity) {
  const auto found = trace_levels(measured({{"s1", "s2", 0, 60}, {"s1", "s2", 0.25, 140}}, true));
  EXPECT_EQ(found.size(), 3u);
}

// A frame each at 0, 0.1 … 0.5 s; rows at 0.05, 0.15, 0.35 and 0.45 s.
TEST(Measured, IsSilentWhereATraceHasNoRows) {
  auto law = measured({{"s1", "s2", 0.05, 60},
                       {"s1", "s2", 0.15, 61},
                       {"s1", "s2", 0.35, 62},
                       {"s1", "s2", 0.45, 63}},
                      true);
  law.silence = 120ms;
  const auto found = trace_levels(law);
  ASSERT_EQ(found.size(), 4u) << "not at 0.2 and 0.3 s";
  const std::vector<double> expected{-60, -60, -62, -63};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(found[i], expected[i], 1e-3) << i;
  law.silence = 30ms;
  EXPECT_TRUE(trace_levels(law).empty());
}

}  // namespace
}  // namespace sim::radio::test
