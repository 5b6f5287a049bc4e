#include "results/report/quantiles.h"

#include <gtest/gtest.h>

namespace results::report {
namespace {

// Hyndman and Fan's definition 7 by hand: position (n - 1) p. n = 4: 0.75, 1.5, 2.25.
TEST(Quantiles, InterpolateAsTypeSeven) {
  const auto q = quantiles({40, 10, 30, 20});
  ASSERT_TRUE(q);
  EXPECT_DOUBLE_EQ(q->min, 10);
  EXPECT_DOUBLE_EQ(q->q1, 17.5);
  EXPECT_DOUBLE_EQ(q->median, 25);
  EXPECT_DOUBLE_EQ(q->q3, 32.5);
  EXPECT_DOUBLE_EQ(q->max, 40);
}

TEST(Quantiles, AreOrderStatisticsWhereThePositionIsWhole) {
  const auto q = quantiles({5, 1, 4, 2, 3});
  EXPECT_DOUBLE_EQ(q->q1, 2);
  EXPECT_DOUBLE_EQ(q->median, 3);
  EXPECT_DOUBLE_EQ(q->q3, 4);
}

TEST(Quantiles, OfOneValueAreThatValue) {
  const auto q = quantiles({7});
  EXPECT_DOUBLE_EQ(q->q1, 7);
  EXPECT_DOUBLE_EQ(q->max, 7);
}

TEST(Quantiles, OfNothingAreNone) { EXPECT_FALSE(quantiles({})); }

}  // namespace
}  // namespace results::report
