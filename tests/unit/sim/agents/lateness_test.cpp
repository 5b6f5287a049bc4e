#include "sim/agents/lateness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "hal/types/random.h"

namespace sim::agents {
namespace {

using hal::Duration;

TEST(Lateness, QuantilesAreThoseOfTheSortedValuesWithinOneInterval) {
  hal::RandomStream random(1, "lateness");
  for (const int count : {1, 2, 100, 10'000}) {
    Lateness lateness;
    std::vector<std::int64_t> values;
    for (int i = 0; i < count; ++i) {
      values.push_back(static_cast<std::int64_t>(random.next() >> (1 + random.below(63))));
      lateness.add(Duration{values.back()});
    }
    std::ranges::sort(values);
    for (const double q : {0.0, 0.25, 0.5, 0.99, 1.0}) {
      const std::int64_t exact = values[static_cast<std::size_t>(q * (count - 1))];
      const std::int64_t found = lateness.quantile(q).count();
      EXPECT_GE(found, exact);
      EXPECT_LE(found - exact, exact / 64) << exact;  // ns: an interval is 1/64 of its begin
    }
    EXPECT_EQ(lateness.greatest().count(), values.back());
  }
}

TEST(Lateness, NothingIsNotLateAndTheLongestTimeFits) {
  Lateness lateness;
  EXPECT_EQ(lateness.quantile(0.5), Duration{});
  lateness.add(Duration::max());
  EXPECT_EQ(lateness.quantile(0.5), Duration::max());
  EXPECT_EQ(lateness.greatest(), Duration::max());
}

}  // namespace
}  // namespace sim::agents
