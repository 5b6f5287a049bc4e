// Sums, histograms and quantiles of a stream of values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hal/types/random.h"
#include "results/record/quantile_summary.h"
#include "results/record/value_histogram.h"
#include "results/record/value_sums.h"

namespace results::record::test {
namespace {

using namespace std::chrono_literals;
using hal::Time;

TEST(ValueSumsTest, AreThoseOfTheValues) {
  ValueSums sums;
  for (const double value : {4.0, -1.0, 6.0, 3.0}) sums.add(Time{1s}, value);
  EXPECT_EQ(sums.count(), 4u);
  EXPECT_DOUBLE_EQ(sums.mean(), 3);
  EXPECT_DOUBLE_EQ(sums.deviation(), std::sqrt((1 + 16 + 9 + 0) / 3.0));
  EXPECT_EQ(sums.least(), -1);
  EXPECT_EQ(sums.greatest(), 6);
  EXPECT_EQ(sums.last(), 3);
  EXPECT_EQ(sums.sum(), 12);
}

TEST(ValueSumsTest, CountAValueByHowLongItHeld) {
  ValueSums sums;
  sums.add(Time{1s}, 10);
  sums.add(Time{2s}, 0);
  EXPECT_DOUBLE_EQ(sums.mean_over_time(Time{5s}), 10.0 / 4);
  EXPECT_DOUBLE_EQ(sums.mean(), 5);
}

TEST(ValueSumsTest, AreThatValueOfOneValue) {
  ValueSums sums;
  sums.add(Time{2s}, 7);
  EXPECT_EQ(sums.deviation(), 0);
  EXPECT_EQ(sums.mean_over_time(Time{2s}), 7);
  EXPECT_EQ(sums.mean_over_time(Time{9s}), 7);
}

// R: quantile(1:10000, c(.05, .5), type = 7) is 500.95 5000.50.
TEST(QuantileSummaryTest, IsExactUpToItsLimit) {
  QuantileSummary summary;
  for (std::size_t i = QuantileSummary::kExact; i > 0; --i) summary.add(static_cast<double>(i));
  EXPECT_EQ(summary.error(), 0);
  EXPECT_DOUBLE_EQ(summary.quantile(0.05), 500.95);
  EXPECT_DOUBLE_EQ(summary.quantile(0.5), 5000.5);
  EXPECT_EQ(summary.quantile(0), 1);
  EXPECT_EQ(summary.quantile(1), 10'000);
}

/// The greatest error of rank over many shares, as a share.
double worst_error(std::vector<double> values) {
  QuantileSummary summary;
  for (const double value : values) summary.add(value);
  std::sort(values.begin(), values.end());
  double worst = 0;
  for (int i = 0; i <= 1000; ++i) {
    const double p = i / 1000.0;
    const double found = summary.quantile(p);
    const auto [low, high] = std::equal_range(values.begin(), values.end(), found);
    EXPECT_NE(low, high) << "no value of the stream";
    const auto n = static_cast<double>(values.size());
    const double least = static_cast<double>(low - values.begin() + 1) / n;
    const double most = static_cast<double>(high - values.begin()) / n;
    worst = std::max({worst, least - p - 1 / n, p - most});
  }
  return worst;
}

TEST(QuantileSummaryTest, IsWithinItsErrorForAnyOrder) {
  constexpr int kMany = 100'000;
  hal::RandomStream random(1, "quantiles");
  std::vector<double> uniform, rising(kMany), falling(kMany), few;
  for (int i = 0; i < kMany; ++i) {
    uniform.push_back(random.uniform());
    few.push_back(std::floor(5 * random.uniform()));
  }
  std::iota(rising.begin(), rising.end(), 0.0);
  std::iota(falling.rbegin(), falling.rend(), 0.0);
  for (const auto& values : {uniform, rising, falling, few}) {
    EXPECT_LE(worst_error(values), QuantileSummary::kError + 1e-9);
  }
}

std::uint64_t all_of(const std::vector<Bins::Bin>& bins) {
  std::uint64_t sum = 0;
  for (const Bins::Bin& bin : bins) sum += bin.count;
  return sum;
}

TEST(ValueHistogramTest, CountsWhatIsOutsideItsRange) {
  ValueHistogram histogram(4, std::pair{0.0, 2.0});
  for (const double value : {-1.0, 0.0, 0.49, 0.5, 1.99, 2.0, 7.0}) histogram.add(value);
  const auto bins = histogram.bins();
  ASSERT_EQ(bins.size(), 6u);
  EXPECT_EQ(bins[0].count, 1u);
  EXPECT_EQ(bins[1].count, 2u);
  EXPECT_EQ(bins[2].count, 1u);
  EXPECT_EQ(bins[2].lower, 0.5);
  EXPECT_EQ(bins[4].count, 1u);
  EXPECT_EQ(bins[5].count, 2u);
  EXPECT_TRUE(std::isinf(bins[5].upper));
}

TEST(ValueHistogramTest, FindsItsRange) {
  ValueHistogram histogram(10, std::nullopt);
  for (const double value : {3.0, 5.0, 4.0, 5.0}) histogram.add(value);
  const auto bins = histogram.bins();
  ASSERT_EQ(bins.size(), 10u);
  EXPECT_EQ(bins.front().lower, 3);
  EXPECT_NEAR(bins.back().upper, 5, 1e-8);
  EXPECT_EQ(bins.front().count, 1u);
  EXPECT_EQ(bins.back().count, 2u);
}

TEST(ValueHistogramTest, WidensForWhatComesLater) {
  ValueHistogram histogram(6, std::nullopt);
  for (std::size_t i = 0; i < ValueHistogram::kKept; ++i) histogram.add(i % 2 == 0 ? 0.0 : 1.0);
  histogram.add(1000);
  histogram.add(-1000);
  const auto bins = histogram.bins();
  EXPECT_EQ(bins.size(), 6u);
  EXPECT_EQ(all_of(bins), ValueHistogram::kKept + 2);
  for (const Bins::Bin& bin : bins) {
    const bool has_far =
        (bin.lower <= -1000 && -1000 < bin.upper) || (bin.lower <= 1000 && 1000 < bin.upper);
    if (has_far) {
      EXPECT_GE(bin.count, 1u);
    }
  }
}

TEST(ValueHistogramTest, TakesOneValueAlone) {
  for (const double value : {0.0, -3.5, 1e12}) {
    ValueHistogram histogram(10, std::nullopt);
    histogram.add(value);
    histogram.add(value);
    const auto bins = histogram.bins();
    ASSERT_EQ(bins.size(), 10u);
    EXPECT_EQ(bins.front().count, 2u);
    EXPECT_LT(bins.front().lower, bins.front().upper);
  }
  EXPECT_TRUE(ValueHistogram(10, std::nullopt).bins().empty());
}

}  // namespace
}  // namespace results::record::test
