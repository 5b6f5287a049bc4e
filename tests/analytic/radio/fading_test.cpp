#include "sim/radio/channel/fading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "sim/radio/channel/nakagami.h"
#include "sim/radio/channel/rayleigh.h"
#include "sim/radio/channel/rician.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

constexpr hal::Metres kLambda{0.125};
constexpr hal::Milliwatts kOne{1};
constexpr double kPi = 3.14159265358979323846;

/// Gain of link number n, `along` m beside its first place.
double gain(const PathLoss& fading, int n, double along, double distance = 50, hal::Time at = {}) {
  const auto name = static_cast<std::uint64_t>(n) * 0x9e3779b97f4a7c15u;
  const Site a({0, 0, 0}, 0, name), b({distance, along, 0}, 0, ~name);
  return fading.after(kOne, Path(a, b, at)).value;
}

struct Moments {
  double mean = 0, square = 0;
};
Moments moments(const PathLoss& fading, double distance) {
  constexpr int kLinks = 20'000;
  Moments sum;
  for (int n = 0; n < kLinks; ++n) {
    const double g = gain(fading, n, 0, distance);
    sum.mean += g / kLinks;
    sum.square += g * g / kLinks;
  }
  return sum;
}

// 32 waves of equal power: E g^2 = 2 - 1/32; standard errors 0.7 % and 3 %.
TEST(Rayleigh, HasTheMomentsOfAnExponentialPower) {
  const Moments m = moments(RayleighFading({}, kLambda), 50);
  EXPECT_NEAR(m.mean, 1, 0.03);
  EXPECT_NEAR(m.square, 2, 0.12);
}

// E g^2 = 1 + (2 K + 1) / (K + 1)^2, K a ratio.
TEST(Rician, HasTheMomentsOfItsK) {
  for (const double k : {0.5, 2.0, 10.0}) {
    RicianConfig config;
    config.k = hal::Decibels{10 * std::log10(k)};
    const Moments m = moments(RicianFading(config, kLambda), 50);
    EXPECT_NEAR(m.mean, 1, 0.03) << k;
    EXPECT_NEAR(m.square, 1 + (2 * k + 1) / ((k + 1) * (k + 1)), 0.08) << k;
  }
}

// E g^2 = 1 + 1 / m; m = 0.5 has the heaviest tail: standard error of 20,000: 3.6 %.
TEST(Nakagami, HasTheMomentsOfItsMAtEachDistance) {
  NakagamiConfig config;
  config.m_near = 3;
  config.m_middle = 1.5;
  config.m_far = 0.75;
  const NakagamiFading fading(config, kLambda);
  const std::pair<double, double> cases[] = {{79.9, 3}, {80.1, 1.5}, {199, 1.5}, {201, 0.75}};
  for (const auto& [distance, m] : cases) {
    const Moments found = moments(fading, distance);
    EXPECT_NEAR(found.mean, 1, 0.03) << distance;
    EXPECT_NEAR(found.square, 1 + 1 / m, 0.06 * (1 + 1 / m)) << distance;
  }
}

// Q(1, x) = e^-x; Q(2, x) = (1 + x) e^-x; Q(1/2, x) = erfc(sqrt(x)): what the quantile of an
// exponential e must give is Q(m, m quantile) = e^-e.
TEST(GammaQuantile, InvertsTheClosedFormsOfThreeShapes) {
  const GammaQuantile half(0.5, 32), one(1, 32), two(2, 32);
  for (const double e : {1e-9, 1e-6, 1e-3, 0.1, 0.5, 1.0, 2.0, 5.0, 10.0, 25.0, 32.0}) {
    EXPECT_NEAR(one(e), e, 1e-3 * e);
    const double x = 2 * two(e);
    const double minus_log = x < 1e-3 ? x * x / 2 * (1 - 2 * x / 3) : x - std::log1p(x);
    EXPECT_NEAR(minus_log, e, 3e-3 * e) << e;
    EXPECT_NEAR(-std::log1p(-std::erf(std::sqrt(0.5 * half(e)))), e, 3e-3 * e + 1e-16) << e;
    if (e > 20) break;  // 1 - erf has no digits left
  }
}

/// Up-crossings of a level in a wavelength of the way, over links.
double crossings(const PathLoss& fading, double level) {
  constexpr int kLinks = 150, kWavelengths = 12, kSteps = 64;
  int count = 0;
  for (int n = 0; n < kLinks; ++n) {
    bool was_above = gain(fading, n, 0) > level;
    for (int i = 1; i <= kWavelengths * kSteps; ++i) {
      const bool above = gain(fading, n, i * kLambda.value / kSteps) > level;
      count += above && !was_above;
      was_above = above;
    }
  }
  return static_cast<double>(count) / (kLinks * kWavelengths);
}

// S. O. Rice; Jakes 1974, 1.3-35: sqrt(2 pi) rho exp(-rho^2) per wavelength, rho^2 the level over
// the mean power. Some 1300 crossings: standard error 3 to 5 %, 64 looks per wavelength miss few.
TEST(Rayleigh, CrossesLevelsAsOftenAsRiceSays) {
  const RayleighFading fading({}, kLambda);
  for (const double level : {0.1, 0.5, 1.0}) {
    const double expected = std::sqrt(2 * kPi * level) * std::exp(-level);
    EXPECT_NEAR(crossings(fading, level) / expected, 1, 0.12) << level;
  }
}

// With m = 2 the level x has the rank of the exponential e = 2 x - ln(1 + 2 x).
TEST(Nakagami, CrossesALevelWhenRayleighFadingCrossesThatOfEqualRank) {
  NakagamiConfig config;
  config.m_near = 2;
  const double level = 0.7, e = 2 * level - std::log1p(2 * level);
  const double expected = std::sqrt(2 * kPi * e) * std::exp(-e);
  EXPECT_NEAR(crossings(NakagamiFading(config, kLambda), level) / expected, 1, 0.12);
}

/// Correlation of the powers of two looks, over links.
double correlation(const std::function<double(int)>& first,
                   const std::function<double(int)>& second) {
  constexpr int kLinks = 20'000;
  double products = 0, squares = 0;
  for (int n = 0; n < kLinks; ++n) {
    const double a = first(n) - 1, b = second(n) - 1;
    products += a * b;
    squares += 0.5 * (a * a + b * b);
  }
  return products / squares;
}

// Clarke: the amplitude's autocorrelation is J0(2 pi v t / lambda), the power's its square. J0 at
// 2 pi times 0.1, 0.2, 0.3827 and 0.6: 0.90371, 0.64255, 0 (its first zero), -0.40244.
constexpr std::pair<double, double> kBessel[] = {
    {0.1, 0.903712}, {0.2, 0.642549}, {0.382740, 0}, {0.6, -0.402440}};

TEST(Rayleigh, DecorrelatesWithTheWayAsClarkeSays) {
  const RayleighFading fading({}, kLambda);
  for (const auto& [wavelengths, bessel] : kBessel) {
    const double along = wavelengths * kLambda.value;
    EXPECT_NEAR(correlation([&](int n) { return gain(fading, n, 0); },
                            [&](int n) { return gain(fading, n, along); }),
                bessel * bessel, 0.04)
        << wavelengths;
  }
}

TEST(Rayleigh, OfStandingNodesDecorrelatesWithTheScatterersSpeed) {
  RayleighConfig config;
  config.scatterer_speed = 2;  // m/s: a wavelength lasts 62.5 ms
  const RayleighFading fading(config, kLambda);
  EXPECT_TRUE(fading.changes_in_time());
  for (const auto& [wavelengths, bessel] : kBessel) {
    const hal::Time later = hal::Time{10s} + hal::from_seconds(wavelengths * 0.0625);
    EXPECT_NEAR(correlation([&](int n) { return gain(fading, n, 0, 50, hal::Time{10s}); },
                            [&](int n) { return gain(fading, n, 0, 50, later); }),
                bessel * bessel, 0.04)
        << wavelengths;
  }
}

TEST(Rayleigh, IsFrozenWhereNothingMoves) {
  const RayleighFading fading({}, kLambda);
  EXPECT_FALSE(fading.changes_in_time());
  EXPECT_EQ(gain(fading, 7, 0), gain(fading, 7, 0, 50, hal::Time{99s}));
}

TEST(Fadings, NeverGainMoreThanTheySay) {
  const RayleighFading rayleigh({}, kLambda);
  const RicianFading rician({}, kLambda);
  const NakagamiFading nakagami({}, kLambda);
  for (const PathLoss* fading : std::vector<const PathLoss*>{&rayleigh, &rician, &nakagami}) {
    for (int n = 0; n < 5000; ++n) EXPECT_LE(gain(*fading, n, 0), fading->most_gain());
  }
}

}  // namespace
}  // namespace sim::radio::test
