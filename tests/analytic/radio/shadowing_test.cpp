#include "sim/radio/channel/shadowing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sim::radio::test {
namespace {

constexpr int kLinks = 20'000;
constexpr ShadowingConfig kConfig{.sigma = hal::Decibels{6},
                                  .decorrelation_distance = hal::Metres{20}};

double decibels(const Path& path) {
  static const Shadowing shadowing(kConfig);
  return 10 * std::log10(shadowing.after(hal::Milliwatts{1}, path).value);
}

/// Of link number n.
double shadow(int n, const hal::Vec3& from, const hal::Vec3& to) {
  const auto name = static_cast<std::uint64_t>(n) * 0x9e3779b97f4a7c15u;
  const Site a(from, 0, name), b(to, 0, ~name);
  return decibels(Path(a, b));
}

// A normal distribution whose tails are put at +-3 sigma has the standard deviation 0.9975 sigma:
// 1 - 2 (3 phi(3) + Q(3)) + 18 Q(3) = 0.99501 is its variance. Standard errors of 20,000 links: 0.5
// % of sigma, and 0.7 % of it for the mean.
TEST(Shadowing, HasItsSigmaAndIsCutAtThreeTimesThat) {
  double sum = 0, squares = 0, largest = 0;
  int beyond_one = 0, beyond_two = 0;
  for (int n = 0; n < kLinks; ++n) {
    const double x = shadow(n, {3, 4, 0}, {50, -20, 0}) / kConfig.sigma.value;
    sum += x;
    squares += x * x;
    largest = std::max(largest, std::abs(x));
    beyond_one += std::abs(x) > 1;
    beyond_two += std::abs(x) > 2;
  }
  EXPECT_NEAR(sum / kLinks, 0, 0.03);
  EXPECT_NEAR(std::sqrt(squares / kLinks), 0.9975, 0.02);
  EXPECT_LE(largest, 3 + 1e-9);
  EXPECT_NEAR(static_cast<double>(beyond_one) / kLinks, 0.3173, 0.015);
  EXPECT_NEAR(static_cast<double>(beyond_two) / kLinks, 0.0455, 0.007);
}

// Gudmundson: exp(-distance / decorrelation distance); standard error of 20,000 pairs: 0.007.
TEST(Shadowing, DecorrelatesExponentiallyWithTheWayOfEitherEnd) {
  struct Case {
    hal::Vec3 from, to;
    double expected;
  };
  const Case cases[] = {{{0, 0, 0}, {75, 0, 0}, std::exp(-0.25)},  // one end by 5 m
                        {{0, 0, 0}, {80, 0, 0}, std::exp(-0.5)},
                        {{0, 0, 0}, {70, 20, 0}, std::exp(-1.0)},
                        {{-40, 0, 0}, {70, 0, 0}, std::exp(-2.0)},
                        {{0, 10, 0}, {70, 10, 0}, std::exp(-1.0)}};  // both, side by side
  for (const Case& c : cases) {
    double products = 0, squares = 0;
    for (int n = 0; n < kLinks; ++n) {
      const double before = shadow(n, {0, 0, 0}, {70, 0, 0});
      const double after = shadow(n, c.from, c.to);
      products += before * after;
      squares += 0.5 * (before * before + after * after);
    }
    EXPECT_NEAR(products / squares, c.expected, 0.03) << c.from.x << " " << c.to.x;
  }
}

TEST(Shadowing, IsTheSameInBothDirectionsAndOtherwiseIndependent) {
  const hal::Vec3 here{1, 2, 0}, there{30, 5, 0};
  const Site a(here, 0, 11), b(there, 0, 12), c(there, 0, 13);
  EXPECT_EQ(decibels(Path(a, b)), decibels(Path(b, a)));
  EXPECT_NE(decibels(Path(a, b)), decibels(Path(a, c)));
  double products = 0, squares = 0;
  for (int n = 1; n < kLinks; ++n) {
    const double x = shadow(n, here, there), y = shadow(n - 1, here, there);
    products += x * y;
    squares += x * x;
  }
  EXPECT_NEAR(products / squares, 0, 0.03);
}

TEST(Shadowing, GainsNoMoreThanItSays) {
  EXPECT_NEAR(10 * std::log10(Shadowing(kConfig).most_gain()), 18, 1e-9);  // dB
}

}  // namespace
}  // namespace sim::radio::test
