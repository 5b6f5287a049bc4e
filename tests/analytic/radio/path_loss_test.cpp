#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "sim/radio/channel/log_distance.h"
#include "sim/radio/channel/two_ray_ground.h"
#include "sim/radio/channel/two_ray_interference.h"
#include "tests/support/slope.h"

namespace sim::radio::test {
namespace {

constexpr double kLambda = 299792458.0 / 2.412e9;  // m
constexpr hal::Milliwatts kSent{40};
constexpr double kPi = 3.14159265358979323846;

double left_in_db(const PathLoss& loss, const Site& from, const Site& to) {
  return 10 * std::log10(loss.after(kSent, Path(from, to)).value / kSent.value);
}

// Heights 1.5 m: crossover at 4 pi 1.5^2 / lambda = 227.5 m. Below it Friis, 20 log10(lambda / 4 pi
// d); beyond it 20 log10(ht hr) - 40 log10(d); d from antenna to antenna. dB, rounding only.
TEST(TwoRayGround, FollowsItsClosedFormAtTwelveDistances) {
  const TwoRayGround loss{hal::Metres{kLambda}, *kFlatGround};
  for (const double d :
       {1.0, 5.0, 20.0, 50.0, 100.0, 200.0, 227.0, 228.0, 300.0, 500.0, 1e3, 5e3}) {
    const double friis = 20 * std::log10(kLambda / (4 * kPi * d));
    const double rays = 20 * std::log10(1.5 * 1.5) - 40 * std::log10(d);
    EXPECT_NEAR(left_in_db(loss, Site({0, 0, 0}, 1.5), Site({d, 0, 0}, 1.5)),
                d < 227.5 ? friis : rays, 1e-9)
        << d << " m";
  }
}

TEST(TwoRayGround, TakesTheHeightsOfTheAntennas) {
  const TwoRayGround loss{hal::Metres{kLambda}, *kFlatGround};
  const double d = std::sqrt(4e6 + 9);  // 2 km away and 3 m higher: beyond the crossover, 1011 m
  const double rays = 20 * std::log10(2.0 * 5.0) - 40 * std::log10(d);
  EXPECT_NEAR(left_in_db(loss, Site({0, 0, 1}, 1), Site({2000, 0, 0}, 5)), rays, 1e-9);
  EXPECT_EQ(loss.after(kSent, Path(Site({0, 0, 0}), Site({5, 0, 0}, 1.5))).value, 0);
}

// Each antenna above the ground where it stands: 1 m and 5 m on a slope from 7 m to 27 m.
TEST(TwoRayGround, TakesTheHeightsAboveTheGroundAtEitherEnd) {
  const tests::Slope slope(7, 0.01);
  const TwoRayGround loss{hal::Metres{kLambda}, slope};
  const double d = std::sqrt(4e6 + 24 * 24);
  EXPECT_NEAR(left_in_db(loss, Site({0, 0, 7}, 1), Site({2000, 0, 27}, 5)),
              20 * std::log10(1.0 * 5.0) - 40 * std::log10(d), 1e-9);
}

/// The sum of both rays' fields, by the lengths of the ways to the antenna and to its image below
/// the ground. dB
double two_fields(double ht, double hr, double across, double reflection) {
  const double direct = std::hypot(across, ht - hr), reflected = std::hypot(across, ht + hr);
  const auto ray = [](double length) {
    return std::polar(1 / length, -2 * kPi * length / kLambda);
  };
  const auto field = ray(direct) + reflection * ray(reflected);
  return 20 * std::log10(kLambda / (4 * kPi) * std::abs(field));
}

// dB: the phase of a way of 5 km is known to 2 pi 5000 / 0.124 * 1e-16 rad, which matters in the
// deepest null, 40 dB below.
TEST(TwoRayInterference, AddsTheFieldsOfBothRays) {
  for (const double reflection : {-1.0, -0.6, 0.0, 0.5, 1.0}) {
    const TwoRayInterference loss{hal::Metres{kLambda}, reflection, *kFlatGround};
    for (double across = 2; across < 5000; across *= 1.07) {
      EXPECT_NEAR(left_in_db(loss, Site({0, 0, 0}, 5), Site({across, 0, 0}, 2)),
                  two_fields(5, 2, across, reflection), 1e-6)
          << across << " m, " << reflection;
    }
  }
}

// With R = -1 both rays cancel where they differ by a wavelength: for 5 m and 2 m near 2 ht hr /
// lambda = 160.9 m.
TEST(TwoRayInterference, HasItsLastNullWhereTheRaysDifferByOneWave) {
  double near = 100, far = 200;
  for (int i = 0; i < 100; ++i) {
    const double middle = (near + far) / 2;
    const double waves = (std::hypot(middle, 7) - std::hypot(middle, 3)) / kLambda;
    (waves > 1 ? near : far) = middle;
  }
  EXPECT_NEAR(near, 2 * 5 * 2 / kLambda, 1);
  const TwoRayInterference loss{hal::Metres{kLambda}, -1, *kFlatGround};
  const auto at = [&](double across) {
    return left_in_db(loss, Site({0, 0, 0}, 5), Site({across, 0, 0}, 2));
  };
  const double friis = 20 * std::log10(kLambda / (4 * kPi * near));
  EXPECT_LT(at(near), friis - 30);
  for (const double across : {140.0, 150.0, 170.0, 180.0}) EXPECT_GT(at(across), at(near) + 10);
}

// Far away with R = -1: ht^2 hr^2 / d^4, as two_ray_ground has it beyond its crossover. dB: the
// next term is (2 pi ht hr / (lambda d))^2 / 3 of it.
TEST(TwoRayInterference, FallsWithTheFourthPowerFarAway) {
  const TwoRayInterference loss{hal::Metres{kLambda}, -1, *kFlatGround};
  const TwoRayGround far{hal::Metres{kLambda}, *kFlatGround};
  const Site from({0, 0, 0}, 1.5), to({20'000, 0, 0}, 1.5);
  EXPECT_NEAR(left_in_db(loss, from, to), left_in_db(far, from, to), 1e-3);
}

TEST(TwoRayInterference, TakesHeightsAboveTheGroundAndNoneBelow) {
  const TwoRayInterference low{hal::Metres{kLambda}, -0.6, *kFlatGround};
  const tests::Slope plane(1000, 0);
  const TwoRayInterference high{hal::Metres{kLambda}, -0.6, plane};
  EXPECT_NEAR(left_in_db(high, Site({0, 0, 1000}, 2), Site({90, 0, 1000}, 2)),
              left_in_db(low, Site({0, 0, 0}, 2), Site({90, 0, 0}, 2)), 1e-6);
  // On the ground, and below it, both rays are equally long: (1 + R) of the field. dB
  const double friis = 20 * std::log10(kLambda / (4 * kPi * 90));
  for (const double height : {0.0, -1.0}) {
    EXPECT_NEAR(left_in_db(low, Site({0, 0, height}), Site({90, 0, height}, 0)),
                friis + 20 * std::log10(0.4), 1e-9);
  }
}

TEST(TwoRayInterference, LeavesNoMoreThanWasSent) {
  const TwoRayInterference loss{hal::Metres{kLambda}, 1, *kFlatGround};
  for (const double d : {0.0, 1e-9, 1e-3, 0.01}) {
    EXPECT_LE(loss.after(kSent, Path(Site({0, 0, 0}), Site({d, 0, 0}))), kSent);
  }
}

// 46.6777 dB + 30 log10(d): at 51.3 m with 16.0206 dBm that is -81.96 dBm, where ns-3's detector
// (-82 dBm) ends the range of every DSSS rate (range_ns3.csv).
TEST(LogDistance, GivesNs3sLossesAndItsOwnReach) {
  const LogDistance loss{LogDistanceConfig{}};
  for (const double d : {1.0, 2.0, 10.0, 51.3, 192.4}) {
    EXPECT_NEAR(left_in_db(loss, Site({}), Site({d, 0, 0})), -46.6777 - 30 * std::log10(d), 1e-9);
  }
  EXPECT_NEAR(left_in_db(loss, Site({}), Site({0.2, 0, 0})), -46.6777, 1e-9);
  const hal::Milliwatts least{std::pow(10, -8.2)};
  EXPECT_NEAR(loss.reach(hal::Milliwatts{std::pow(10, 1.60206)}, least),
              std::pow(10, (16.0206 + 82 - 46.6777) / 30), 1e-9);  // 51.4 m
}

TEST(LogDistance, TakesItsParameters) {
  const LogDistance loss{LogDistanceConfig{
      .reference_loss = hal::Decibels{60}, .reference_distance = hal::Metres{10}, .exponent = 2.7}};
  EXPECT_NEAR(left_in_db(loss, Site({}), Site({0, 100, 0})), -87, 1e-9);
}

}  // namespace
}  // namespace sim::radio::test
