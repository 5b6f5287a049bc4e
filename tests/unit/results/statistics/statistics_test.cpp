// What no other program has to say: ends of the ranges, and values worked by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "results/statistics/bootstrap.h"
#include "results/statistics/interval.h"
#include "results/statistics/mser.h"
#include "results/statistics/paired.h"
#include "results/statistics/quantile.h"

namespace results::statistics {
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

// R. G. Newcombe, "Two-sided Confidence Intervals for the Single Proportion: Comparison of Seven
// Methods", Statistics in Medicine 17, 1998, table I, method 3 (Wilson): 81/263, 15/148, 0/20,
// 1/29. Runs that are equal say nothing of their own spread: what is left is Wilson's interval of
// all trials.
TEST(Statistics, OfEqualSharesItIsWilsonsIntervalAsPublished) {
  const auto wilson = [](double successes, double trials) {
    const double share = successes / trials;
    return *mean_interval(Values{share, share}, {Support::Kind::kShare, trials});
  };
  EXPECT_NEAR(wilson(81, 263).low, 0.2553, 5e-5);
  EXPECT_NEAR(wilson(81, 263).high, 0.3662, 5e-5);
  EXPECT_NEAR(wilson(15, 148).low, 0.0624, 5e-5);
  EXPECT_NEAR(wilson(15, 148).high, 0.1605, 5e-5);
  EXPECT_EQ(wilson(0, 20).low, 0);
  EXPECT_NEAR(wilson(0, 20).high, 0.1611, 5e-5);
  EXPECT_NEAR(wilson(1, 29).low, 0.0061, 5e-5);
  EXPECT_NEAR(wilson(1, 29).high, 0.1718, 5e-5);
  EXPECT_EQ(wilson(29, 29).high, 1);
  EXPECT_NEAR(wilson(29, 29).low, 1 - wilson(0, 29).high, 1e-15);
}

// Student's interval of ten counts is -0.126 .. 0.326, of five shares 0.93 .. 1.02.
TEST(Statistics, IntervalsOfCountsAndSharesStayWhereTheseCanBe) {
  const Values counts = {0, 0, 1, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_LT(mean_interval(counts)->low, 0);
  const auto of_counts = *mean_interval(counts, {Support::Kind::kCount, {}});
  EXPECT_GT(of_counts.low, 0);
  EXPECT_LT(of_counts.low, 0.1);
  EXPECT_GT(of_counts.high, mean_interval(counts)->high) << "it is moved, not cut off";
  const Values shares = {1, 0.9, 1, 1, 0.98};
  EXPECT_GT(mean_interval(shares)->high, 1);
  const auto of_shares = *mean_interval(shares, {Support::Kind::kShare, {}});
  EXPECT_LT(of_shares.high, 1);
  EXPECT_LT(of_shares.low, mean_interval(shares)->low);
}

// (1 - mu)^2 <= k mu with k = t^2 sd^2 / (n mean): 1, 2, 3 less 1: mean 1, sd 1, t(0.975, 2) =
// 4.302653, so k = 6.170940 and mu = 1 + k / 2 -+ sqrt(k + k^2 / 4).
TEST(Statistics, TheScoreIntervalOfThreeCountsByHand) {
  const auto interval = *mean_interval(Values{0, 1, 2}, {Support::Kind::kCount, {}});
  EXPECT_NEAR(interval.low, 0.124275, 1e-5);
  EXPECT_NEAR(interval.high, 8.046665, 1e-5);
  EXPECT_NEAR(interval.low * interval.high, 1, 1e-12) << "the square of the mean";
}

// Poisson events of which none came: mu <= z^2 / n; G. J. Hahn's and others' rule says 3.7 / n.
TEST(Statistics, ZeroOfEveryRunIsNoProofOfZero) {
  const auto counts = *mean_interval(Values(10, 0.0), {Support::Kind::kCount, {}});
  EXPECT_EQ(counts.low, 0);
  EXPECT_NEAR(counts.high, 0.384146, 1e-6);
  const auto times = *mean_interval(Values(10, 0.0), {Support::Kind::kNotNegative, {}});
  EXPECT_EQ(times.high, 0) << "nothing is known of what does not come one by one";
}

// Far from the ends it is Student's: 1000 runs' mean of 100 with deviation 1.
TEST(Statistics, FarFromTheEndsTheScoreIsStudentsInterval) {
  Values values;
  for (int i = 0; i < 1000; ++i) values.push_back(100 + (i % 2 == 0 ? 1 : -1));
  const auto student = *mean_interval(values);
  const auto score = *mean_interval(values, {Support::Kind::kNotNegative, {}});
  EXPECT_NEAR(score.low, student.low, 3e-5);
  EXPECT_NEAR(score.high, student.high, 3e-5);
  for (double& value : values) value = value / 200;
  const auto share = *mean_interval(values, {Support::Kind::kShare, {}});
  EXPECT_NEAR(share.high, mean_interval(values)->high, 1e-6);
}

TEST(Statistics, MoreTrialsThanThereAreAreNotPretended) {
  const Values shares = {0.5, 0.5, 0.5, 0.5};
  const auto few = *mean_interval(shares, {Support::Kind::kShare, 8});
  const auto many = *mean_interval(shares, {Support::Kind::kShare, 800});
  EXPECT_GT(few.high - few.low, 5 * (many.high - many.low));
  // Runs that differ more than trials by chance would: the runs decide.
  const Values spread = {0.2, 0.8, 0.3, 0.7};
  EXPECT_EQ((*mean_interval(spread, {Support::Kind::kShare, 800})).high,
            (*mean_interval(spread, {Support::Kind::kShare, 8000})).high);
}

TEST(Statistics, ADifferenceOfSharesIsNoMoreThanOne) {
  const Values first = {0.1, 0};
  const Values second = {0.9, 1};
  EXPECT_GT(compare_pairs(first, second)->interval.high, 1);
  const auto shares = compare_pairs(first, second, Support::Kind::kShare);
  EXPECT_LE(shares->interval.high, 1);
  EXPECT_GE(shares->interval.low, -1);
  EXPECT_EQ(*shares->p, *compare_pairs(first, second)->p);
}

TEST(Statistics, ValuesOutsideOfTheirRangeHaveStudentsInterval) {
  const Values values = {-1, 2, 3};
  EXPECT_EQ(mean_interval(values, {Support::Kind::kCount, {}})->low, mean_interval(values)->low);
  EXPECT_FALSE(mean_interval(Values{3}, {Support::Kind::kCount, {}}));
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
}  // namespace results::statistics
