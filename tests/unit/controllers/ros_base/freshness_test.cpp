#include "controllers/ros_base/freshness.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace std::chrono_literals;
using Values = std::vector<double>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

hal::Time at(hal::Duration since_start) { return hal::Time{} + since_start; }

TEST(Freshness, WithoutAPeriodEveryReadingIsNew) {
  controllers::Freshness freshness(0ms);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(freshness.is_new(Values{1, kNan}, at(i * 100ms))) << i;
}

TEST(Freshness, EqualValuesAreNewOncePerPeriod) {
  controllers::Freshness freshness(200ms);
  std::vector<bool> found;
  for (int i = 0; i < 6; ++i) found.push_back(freshness.is_new(Values{1, kNan}, at(i * 100ms)));
  EXPECT_EQ(found, (std::vector<bool>{true, false, true, false, true, false}));
}

TEST(Freshness, OtherValuesAreNewAtOnceAndThePeriodBeginsAnew) {
  controllers::Freshness freshness(300ms);
  EXPECT_TRUE(freshness.is_new(Values{1}, at(0ms)));
  EXPECT_FALSE(freshness.is_new(Values{1}, at(100ms)));
  EXPECT_TRUE(freshness.is_new(Values{kNan}, at(200ms)));
  EXPECT_FALSE(freshness.is_new(Values{kNan}, at(400ms)));
  EXPECT_TRUE(freshness.is_new(Values{kNan}, at(500ms)));
  EXPECT_TRUE(freshness.is_new(Values{kNan, kNan}, at(600ms)));
}

TEST(Freshness, ControlCyclesThatDoNotDivideThePeriodKeepItsRate) {
  controllers::Freshness freshness(200ms);
  int found = 0;
  for (int i = 0; i < 1000; ++i) found += freshness.is_new(Values{1}, at(i * 70ms)) ? 1 : 0;
  EXPECT_NEAR(found, 1000 * 70.0 / 200, 1);
}

}  // namespace
