// What no other program has to say: ends of the ranges, and values worked by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/statistics/bootstrap.h"
#include "sim/statistics/interval.h"
#include "sim/statistics/mser.h"
#include "sim/statistics/paired.h"
#include "sim/statistics/quantile.h"

namespace sim::statistics {
namespace {

using Values = std::vector<double>;

TEST(Statistics, OfNothingOrOfOneValueThereIsNoInterval) {
  EXPECT_FALSE(moments(Values{}));
  EXPECT_FALSE(quantile({}, 0.5));
  EXPECT_EQ(moments(Values{3})->sd, 0);
  EXPECT_FALSE(mean_interval(Values{3}));
  EXPECT_FALSE(compare_pairs(Values{3}, Values{4}));
  EXPECT_FALSE(quantile_interval({}, 0.5));
}

TEST(Statistics, EqualValuesHaveAnIntervalWithoutWidthAndNoTest) {
  const auto interval = mean_interval(Values{2, 2, 2});
  EXPECT_EQ(interval->low, 2);
  EXPECT_EQ(interval->high, 2);
  const auto pairs = compare_pairs(Values{1, 1, 1}, Values{2, 2, 2});
  EXPECT_EQ(pairs->difference.mean, 1);
  EXPECT_FALSE(pairs->t);
  EXPECT_FALSE(pairs->p);
  EXPECT_FALSE(pairs->correlation);
  const Values equal(8, 2.0);
  const Resamples resamples(8, 99, 1, "equal");
  EXPECT_FALSE(bca_interval(equal, bootstrap(equal, resamples, mean_of), mean_of));
  EXPECT_EQ(percentile_interval(bootstrap(equal, resamples, mean_of)).high, 2);
}

// t(0.975, 2) = 4.302653 by tables; 1, 2, 3: mean 2, sd 1.
TEST(Statistics, StudentsIntervalOfThreeValuesByHand) {
  const auto interval = mean_interval(Values{3, 1, 2});
  EXPECT_NEAR(interval->high - 2, 4.302653 / std::sqrt(3), 1e-6);
  EXPECT_NEAR(2 - interval->low, 4.302653 / std::sqrt(3), 1e-6);
}

// 2 / 2^6 = 0.031 are outside of the extremes of six values, 2 / 2^5 = 0.0625 of those of five.
TEST(Statistics, TheMedianHasAnIntervalFromSixValuesOn) {
  EXPECT_FALSE(quantile_interval({1, 2, 3, 4, 5}, 0.5));
  const auto six = quantile_interval({6, 5, 4, 3, 2, 1}, 0.5);
  ASSERT_TRUE(six);
  EXPECT_EQ(six->interval.low, 1);
  EXPECT_EQ(six->interval.high, 6);
  EXPECT_DOUBLE_EQ(six->coverage, 1 - 2 / 64.0);
}

// The interval of a minimum has no lower end, whatever the number of values.
TEST(Statistics, ExtremesHaveNoInterval) {
  EXPECT_FALSE(quantile_interval(Values(100, 1), 0));
  EXPECT_FALSE(quantile_interval(Values(100, 1), 1));
}

TEST(Statistics, ResamplesFollowSeedAndName) {
  const Resamples one(4, 3, 1, "x");
  EXPECT_EQ(one.csv(), Resamples(4, 3, 1, "x").csv());
  EXPECT_NE(one.csv(), Resamples(4, 3, 2, "x").csv());
  EXPECT_NE(one.csv(), Resamples(4, 3, 1, "y").csv());
  EXPECT_EQ(one.size(), 3U);
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (const std::uint32_t index : one[i]) EXPECT_LT(index, 4U);
  }
}

// Batches 100, 0, 0, 0: without the first one nothing is left of the deviations.
TEST(Statistics, AStepIsCutOffAndWhatFillsNoBatchIsNotLookedAt) {
  Values series(20, 0.0);
  for (int i = 0; i < 5; ++i) series[static_cast<std::size_t>(i)] = 100;
  series.push_back(1e6);
  const auto cut = mser(series);
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->values, 5U);
  EXPECT_FALSE(cut->is_too_short);
  EXPECT_FALSE(mser(Values(9, 1.0)));
  EXPECT_EQ(mser(Values(10, 1.0))->values, 0U);
}

// The differences are +1 each but for one of +2, while the values themselves go over decades.
TEST(Statistics, PairsSeeWhatTheSpreadOfTheValuesHides) {
  const Values first = {1, 10, 100, 1000, 10000};
  const Values second = {2, 11, 101, 1001, 10002};
  const auto pairs = compare_pairs(first, second);
  EXPECT_NEAR(pairs->difference.mean, 1.2, 1e-12);
  EXPECT_GT(pairs->interval.low, 0);
  EXPECT_LT(mean_interval(second)->low, 0);
  EXPECT_GT(*pairs->correlation, 0.999);
}

}  // namespace
}  // namespace sim::statistics
