#include "results/report/log_histogram.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <numeric>

namespace results::report::test {
namespace {

// A decade is 40 / 6 bins, a bin 0.15 decades: 1 ms = 10^-3 is 1 / 0.15 = 6.67 bins above the lower
// edge of 10^-4 s, in bin 6; 1 s is 4 / 0.15 = 26.67, in bin 26; 50 s is (log10(50) + 4) / 0.15 =
// 37.99, in bin 37.
TEST(LogHistogram, PutsATimeInTheBinOfItsLogarithm) {
  const LogHistogram histogram = log_histogram({1e-3, 1.0, 50.0});
  for (std::size_t i = 0; i < histogram.bins.size(); ++i) {
    EXPECT_EQ(histogram.bins[i], i == 6 || i == 26 || i == 37 ? 1 : 0) << i;
  }
}

// The upper edge of bin 0 is 10^-3.85 = 0.14125 ms.
TEST(LogHistogram, SeparatesTimesAtAnEdge) {
  const LogHistogram histogram = log_histogram({0.1412e-3, 0.1413e-3});
  EXPECT_EQ(histogram.bins[0], 1u);
  EXPECT_EQ(histogram.bins[1], 1u);
}

TEST(LogHistogram, HoldsBothEndsOfTheScale) {
  const LogHistogram histogram = log_histogram({LogHistogram::kLow, LogHistogram::kHigh});
  EXPECT_EQ(histogram.bins.front(), 1u);
  EXPECT_EQ(histogram.bins.back(), 1u);
}

TEST(LogHistogram, CountsZerosAndTimesBeyondTheEndsApart) {
  const LogHistogram histogram = log_histogram({0, 0, 0, 0.99e-4, 100.1, 3600});
  EXPECT_EQ(histogram.zeros, 3u);
  EXPECT_EQ(histogram.below, 1u);
  EXPECT_EQ(histogram.above, 2u);
  EXPECT_EQ(std::accumulate(histogram.bins.begin(), histogram.bins.end(), 0u), 0u);
}

}  // namespace
}  // namespace results::report::test
