#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "hal/types/math.h"
#include "hal/types/random.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"

namespace {

using hal::RandomStream;

TEST(RandomStream, DependsOnSeedAndNameOnly) {
  EXPECT_EQ(RandomStream(1, "m1/backoff").next(), RandomStream(1, "m1/backoff").next());
  EXPECT_NE(RandomStream(1, "m1/backoff").next(), RandomStream(2, "m1/backoff").next());
  EXPECT_NE(RandomStream(1, "m1/backoff").next(), RandomStream(1, "m2/backoff").next());
}

// Chi-square with 9 degrees of freedom: 27.88 is exceeded with probability 0.001.
TEST(RandomStream, BelowIsUniform) {
  RandomStream random(7, "chi");
  std::array<int, 10> counts{};
  constexpr int kDraws = 100'000;
  for (int i = 0; i < kDraws; ++i) ++counts[random.below(10)];
  double chi_square = 0;
  for (const int n : counts)
    chi_square += (n - kDraws / 10.0) * (n - kDraws / 10.0) / (kDraws / 10.0);
  EXPECT_LT(chi_square, 27.88);
}

// Mean of n uniforms is normal with sigma = 1/sqrt(12 n): 5 sigma allowed. Likewise for normals.
TEST(RandomStream, MomentsOfUniformAndNormal) {
  RandomStream random(3, "moments");
  constexpr int kDraws = 200'000;
  double uniform = 0, normal = 0, square = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    uniform += u;
    const double z = random.normal();
    normal += z;
    square += z * z;
  }
  EXPECT_NEAR(uniform / kDraws, 0.5, 5 / std::sqrt(12.0 * kDraws));
  EXPECT_NEAR(normal / kDraws, 0.0, 5 / std::sqrt(1.0 * kDraws));
  EXPECT_NEAR(square / kDraws, 1.0, 5 * std::sqrt(2.0 / kDraws));
}

TEST(Math, AgreesWithTheLanguagesLibraryToOneUnitInTheLastPlaces) {
  for (double x = -6.0; x < 6.0; x += 0.01) {
    EXPECT_NEAR(hal::math::sin(x), std::sin(x), 2.3e-16);
    EXPECT_NEAR(hal::math::cos(x), std::cos(x), 2.3e-16);
    EXPECT_NEAR(hal::math::exp(x) / std::exp(x), 1.0, 4.5e-16);
    EXPECT_NEAR(hal::math::atan2(x, 0.7), std::atan2(x, 0.7), 4.5e-16);
    EXPECT_NEAR(hal::math::erfc(x), std::erfc(x), 9e-16);
  }
}

TEST(Math, WrapAngleKeepsTheHalfOpenInterval) {
  using hal::math::kPi;
  using hal::math::wrap_angle;
  EXPECT_DOUBLE_EQ(wrap_angle(kPi), kPi);
  EXPECT_DOUBLE_EQ(wrap_angle(-kPi), kPi);
  EXPECT_NEAR(wrap_angle(7 * kPi / 2), -kPi / 2, 1e-15);
  EXPECT_NEAR(wrap_angle(-5 * kPi / 2), -kPi / 2, 1e-15);
}

TEST(Time, SecondsRoundToTheNearestNanosecond) {
  EXPECT_EQ(hal::from_seconds(1.4e-9).count(), 1);
  EXPECT_EQ(hal::from_seconds(1.6e-9).count(), 2);
  EXPECT_EQ(hal::from_seconds(-1.6e-9).count(), -2);
}

TEST(Verdict, EveryOneHasItsOwnName) {
  std::set<std::string_view> names;
  for (int v = 0; v < hal::kVerdictCount; ++v)
    names.insert(hal::name(static_cast<hal::Verdict>(v)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(hal::kVerdictCount));
}

}  // namespace
