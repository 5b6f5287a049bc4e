#include "hal/types/path_metric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace hal {
namespace {

using namespace std::chrono_literals;

constexpr AgentId kDestination{99};

PathStatistics path(std::uint16_t hops, Duration delay, double snr_db, double energy) {
  return {.hops = hops, .delay = delay, .min_snr_db = snr_db, .energy = energy};
}

double value(const PathMetric& metric, const PathStatistics& path) {
  return path_value(metric, path, false);
}

TEST(PathMetric, OneStatisticAloneIsItsOwnValue) {
  const auto p = path(4, 20ms, 10, 0.25);
  EXPECT_EQ(value({}, p), 0.25);
  EXPECT_EQ(value(path_metric(PathStatistic::kHops), p), 0.25);
  EXPECT_DOUBLE_EQ(value(path_metric(PathStatistic::kDelay), p), 50);
  EXPECT_EQ(value(path_metric(PathStatistic::kEnergy), p), 4);
  // 10 dB: log2(1 + 10).
  EXPECT_NEAR(value(path_metric(PathStatistic::kMinSnr), p), 3.459431618637297, 1e-12);
}

// (1/4)^2 * (50)^0.5, by hand 0.0625 * 7.0710678…
TEST(PathMetric, WeighsSeveralStatisticsAsAProductOfPowers) {
  const PathMetric metric{.hops = 2, .delay = 0.5};
  EXPECT_NEAR(value(metric, path(4, 20ms, 0, 0)), 0.4419417382415922, 1e-12);
}

TEST(PathMetric, GrowsWithTheSnrOfTheWeakestLink) {
  const auto metric = path_metric(PathStatistic::kMinSnr);
  double last = 0;
  for (const double snr : {-90.0, -10.0, 0.0, 3.0, 20.0, 40.0}) {
    const double r = value(metric, path(1, 1ms, snr, 1));
    EXPECT_GT(r, last) << snr << " dB";
    last = r;
  }
}

TEST(PathMetric, TheDestinationItselfCountsByItsWeightIfItHasOne) {
  const auto p = path(1, 1ms, 20, 1);
  EXPECT_EQ(path_value({}, p, true), 1e6);
  EXPECT_EQ(path_value({.direct_weight = 7}, p, true), 7);
  EXPECT_EQ(path_value({.hops = 0, .delay = 1, .direct_weight = 0}, p, true), 1000);
}

TEST(PathMetric, StaysFiniteAndPositiveWhateverThePath) {
  const PathMetric all{.hops = 100, .delay = 100, .min_snr = 100, .energy = 100};
  for (const auto& p :
       {path(0, 0ns, -1e9, 0), path(65535, 24h, 1e9, 1e9), path(1, 1ns, 0, 1e-30)}) {
    const double r = value(all, p);
    EXPECT_TRUE(std::isfinite(r));
    EXPECT_GT(r, 0);
  }
}

TEST(PathMetric, StatisticsAreKnownByName) {
  for (const PathStatistic statistic : kPathStatistics) {
    EXPECT_EQ(path_statistic(name(statistic)), statistic);
  }
  EXPECT_FALSE(path_statistic("hop"));
}

Route via(std::uint16_t next_hop, const PathStatistics& path) {
  return {"help", kDestination, AgentId{next_hop}, path};
}

// Four ways, each the best in one statistic: a metric sends most draws down its own.
TEST(DrawRoute, EachStatisticPrefersAnotherWay) {
  const std::vector<Route> routes{via(1, path(2, 90ms, 5, 9)), via(2, path(6, 10ms, 5, 9)),
                                  via(3, path(6, 90ms, 40, 9)), via(4, path(6, 90ms, 5, 1))};
  for (const PathStatistic statistic : kPathStatistics) {
    RandomStream random(3, "draw");
    std::map<std::size_t, int> counts;
    for (int i = 0; i < 1000; ++i) ++counts[draw_route(routes, path_metric(statistic), 4, random)];
    EXPECT_GT(counts[static_cast<std::size_t>(statistic)], 900) << name(statistic);
  }
}

// r = 1/2 and 1/4 with beta 2: 4 against 1, so 0.8 and 0.2 of 10000; 5 sigma are 200.
TEST(DrawRoute, FollowsEquation1) {
  const std::vector<Route> routes{via(1, path(2, 1ms, 0, 0)), via(2, path(4, 1ms, 0, 0))};
  RandomStream random(4, "draw");
  int first = 0;
  for (int i = 0; i < 10000; ++i) first += draw_route(routes, {}, 2, random) == 0 ? 1 : 0;
  EXPECT_NEAR(first, 8000, 200);
}

TEST(DrawRoute, AHugeExponentDrawsTheBestInsteadOfOverflowing) {
  const std::vector<Route> routes{via(1, path(3, 1ms, 0, 0)), via(2, path(2, 1ms, 0, 0))};
  RandomStream random(5, "draw");
  for (int i = 0; i < 100; ++i) EXPECT_EQ(draw_route(routes, {}, 5000, random), 1u);
}

}  // namespace
}  // namespace hal
