#include "baraka/campaign/time_left.h"

#include <gtest/gtest.h>

#include <cmath>

namespace baraka::campaign {
namespace {

TEST(TimeLeft, IsNotKnownBeforeTheFirstRunHasEnded) {
  EXPECT_FALSE(TimeLeftEstimate().left({}, {1, 1}, 2));
}

TEST(TimeLeft, IsThatOfThePointsToCome) {
  TimeLeftEstimate estimate;
  estimate.add(1, 10);
  estimate.add(2, 100);
  EXPECT_DOUBLE_EQ(estimate.left({}, {1, 1}, 1)->seconds, 20);
  EXPECT_DOUBLE_EQ(estimate.left({}, {1, 2}, 1)->seconds, 110);
  EXPECT_DOUBLE_EQ(estimate.left({}, {3}, 1)->seconds, 55);  // of a point of which none has ended
}

TEST(TimeLeft, RunsSideBySideAndTheLastOneCounts) {
  TimeLeftEstimate estimate;
  estimate.add(1, 10);
  EXPECT_DOUBLE_EQ(estimate.left({}, {1, 1, 1}, 2)->seconds, 20);  // not 15
  EXPECT_DOUBLE_EQ(estimate.left({{1, 4}, {1, 25}}, {1}, 2)->seconds, 10);
}

// Eleven runs of mean 10 s whose squared deviations sum up to 36 s^2: sd sqrt(3.6) s and t(10) =
// 2.228; five to come one by one, whose sum is off by sd sqrt(5 (1 + 5/11)).
TEST(TimeLeft, HasLimitsFromTheScatterWithinPoints) {
  TimeLeftEstimate estimate;
  estimate.add(1, 10);
  EXPECT_FALSE(estimate.left({}, {1}, 1)->low);
  for (int i = 0; i < 5; ++i) estimate.add(1, 10 - std::sqrt(3.6));
  for (int i = 0; i < 5; ++i) estimate.add(1, 10 + std::sqrt(3.6));
  const double margin = 2.228 * std::sqrt(3.6) * std::sqrt(5 * (1 + 5.0 / 11));
  const auto left = estimate.left({}, {1, 1, 1, 1, 1}, 1);
  EXPECT_NEAR(*left->high, 50 + margin, 1e-9);
  EXPECT_NEAR(*left->low, 50 - margin, 1e-9);
}

TEST(TimeLeft, PointsOfDifferentLengthDoNotWidenTheLimits) {
  TimeLeftEstimate estimate;
  for (int i = 0; i < 3; ++i) {
    estimate.add(1, 10);
    estimate.add(2, 1000);
  }
  const auto left = estimate.left({}, {1, 2}, 1);
  EXPECT_DOUBLE_EQ(*left->low, 1010);
  EXPECT_DOUBLE_EQ(*left->high, 1010);
}

}  // namespace
}  // namespace baraka::campaign
