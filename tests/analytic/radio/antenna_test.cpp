// Gain by direction against closed forms and the sphere's mean.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/radio/channel/antenna.h"

namespace sim::radio::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

hal::Vec3 direction(double azimuth, double elevation) {
  const double a = azimuth * kPi / 180, e = elevation * kPi / 180;
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}
double decibels(const AntennaPattern& pattern, double azimuth, double elevation) {
  return 10 * std::log10(pattern.towards(direction(azimuth, elevation)));
}
AntennaPattern beam(double width, double height, double azimuth = 0, double elevation = 0) {
  return AntennaPattern(BeamAntenna{.width = width * kPi / 180,
                                    .height = height * kPi / 180,
                                    .azimuth = azimuth * kPi / 180,
                                    .elevation = elevation * kPi / 180});
}

TEST(Antenna, DipoleFollowsItsClosedFormInAllDirections) {
  const AntennaPattern dipole{DipoleAntenna{}};
  EXPECT_NEAR(decibels(dipole, 0, 0), 2.15, 0.005);
  EXPECT_EQ(dipole.most(), dipole.towards({1, 0, 0}));
  for (const double elevation : {-80.0, -30.0, 10.0, 39.0, 60.0, 85.0}) {
    const double t = (90 - elevation) * kPi / 180;  // from the axis
    const double expected = 1.6409224 * std::pow(std::cos(kPi / 2 * std::cos(t)) / std::sin(t), 2);
    for (const double azimuth : {0.0, 77.0, -120.0})
      EXPECT_NEAR(dipole.towards(direction(azimuth, elevation)), expected, 1e-7) << elevation;
  }
  EXPECT_NEAR(decibels(dipole, 0, 90), -100, 1e-9) << "along its axis";
}

// A lossless antenna only distributes what is sent: the mean over the sphere is 1. The sum over
// 2000 rings is exact to their number squared.
TEST(Antenna, DipoleRadiatesWhatIsSent) {
  const AntennaPattern dipole{DipoleAntenna{}};
  double sum = 0;
  constexpr int kRings = 2000;
  for (int i = 0; i < kRings; ++i) {
    const double sine = -1 + 2 * (i + 0.5) / kRings;  // rings of equal area
    sum += dipole.towards({std::sqrt(1 - sine * sine), 0, sine});
  }
  EXPECT_NEAR(sum / kRings, 1, 1e-5);
}

TEST(Antenna, BeamHasHalfItsPowerAtHalfItsWidths) {
  const AntennaPattern ahead = beam(40, 20);
  EXPECT_NEAR(decibels(ahead, 0, 0), 0, 1e-9);
  for (const auto& [azimuth, elevation, expected] :
       {std::array{20.0, 0.0, -3.0}, std::array{-20.0, 0.0, -3.0}, std::array{0.0, 10.0, -3.0},
        std::array{0.0, -5.0, -0.75}, std::array{40.0, 0.0, -12.0}, std::array{180.0, 0.0, -20.0},
        std::array{0.0, 89.0, -20.0}}) {
    EXPECT_NEAR(decibels(ahead, azimuth, elevation), expected, 1e-9) << azimuth << ' ' << elevation;
  }
}

TEST(Antenna, BeamPointsToItsBoresight) {
  const AntennaPattern left = beam(40, 20, 90), up = beam(40, 20, 0, 30);
  EXPECT_NEAR(decibels(left, 90, 0), 0, 1e-9);
  EXPECT_NEAR(decibels(left, 110, 0), -3, 1e-9);
  EXPECT_NEAR(decibels(up, 0, 30), 0, 1e-9);
  EXPECT_NEAR(decibels(up, 0, 40), -3, 1e-9);
  EXPECT_NEAR(decibels(beam(40, 20, 90, 30), 90, 20), -3, 1e-9);
}

TEST(Antenna, TableIsLinearInDecibelsAndGoesRound) {
  const AntennaPattern table{TableAntenna{{{0, -10, 2},
                                           {90, -10, 0},
                                           {180, -10, -6},
                                           {270, -10, -4},
                                           {0, 30, 4},
                                           {90, 30, 0},
                                           {180, 30, -8},
                                           {270, 30, 0}}}};
  EXPECT_NEAR(table.most(), std::pow(10, 0.4), 1e-12);
  for (const auto& [azimuth, elevation, expected] :
       {std::array{0.0, -10.0, 2.0}, std::array{45.0, -10.0, 1.0}, std::array{0.0, 10.0, 3.0},
        std::array{45.0, 10.0, 1.5}, std::array{-90.0, -10.0, -4.0}, std::array{-45.0, -10.0, -1.0},
        std::array{-135.0, 30.0, -4.0}, std::array{180.0, 80.0, -8.0},
        std::array{90.0, -60.0, 0.0}}) {
    EXPECT_NEAR(decibels(table, azimuth, elevation), expected, 1e-9) << azimuth << ' ' << elevation;
  }
}

TEST(Antenna, TableOfOneRowIsEqualInAllDirections) {
  const AntennaPattern table{TableAntenna{{{0, 0, 3}}}};
  for (const double azimuth : {0.0, 100.0, -100.0})
    EXPECT_NEAR(decibels(table, azimuth, 40), 3, 1e-9);
}

TEST(Antenna, TableMustBeAGrid) {
  EXPECT_TRUE(wrong_rows({{0, 0, 1}, {90, 0, 1}, {0, 45, 1}, {90, 45, 1}}).empty());
  const auto twice = wrong_rows({{0, 0, 1}, {90, 0, 1}, {0, 0, 2}});
  ASSERT_EQ(twice.size(), 1u);
  EXPECT_EQ(twice[0].row, 2u);
  EXPECT_EQ(wrong_rows({{0, 0, 1}, {90, 0, 1}, {0, 45, 1}}).size(), 1u);
  EXPECT_EQ(wrong_rows({{-180, 0, 1}, {360, 0, 1}}).size(), 1u);
}

TEST(Antenna, TurnsWithItsBody) {
  DirectedAntenna antenna(beam(40, 20), {1, 0, 0, 0});
  const hal::Vec3 way{3, 0, 0};
  EXPECT_NEAR(antenna.towards(way), 1, 1e-12);
  const auto yaw = [](double degrees) {
    const double half = degrees * kPi / 360;
    return Attitude{std::cos(half), 0, 0, std::sin(half)};
  };
  for (const double degrees : {20.0, -20.0, 340.0}) {
    EXPECT_TRUE(antenna.turn(yaw(degrees)));
    EXPECT_NEAR(10 * std::log10(antenna.towards(way)), -3, 1e-9) << degrees;
  }
  EXPECT_FALSE(antenna.turn(yaw(340))) << "as it is";
  // Pitched nose up by 10 degrees: about the y axis by -10 degrees.
  antenna.turn({std::cos(5 * kPi / 180), 0, -std::sin(5 * kPi / 180), 0});
  EXPECT_NEAR(10 * std::log10(antenna.towards(way)), -3, 1e-9);
  EXPECT_NEAR(10 * std::log10(antenna.towards(direction(0, 10))), 0, 1e-9);
}

}  // namespace
}  // namespace sim::radio::test
