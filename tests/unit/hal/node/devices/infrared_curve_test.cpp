#include "hal/node/devices/infrared_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace hal::node::devices {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-12;

struct Point {
  double metres, volts;
};

TEST(Gp2d12, GoesThroughThePointsOfTheReplica) {
  const auto curve = InfraredCurve::gp2d12();
  for (const Point p : {Point{0.10, 2.384},
                        {0.15, 1.76},
                        {0.20, 1.40},
                        {0.30, 0.99},
                        {0.40, 0.77},
                        {0.60, 0.53},
                        {0.80, 0.41}})
    EXPECT_NEAR(curve.volts(p.metres), p.volts, 0.01) << p.metres;  // V, as printed: two decimals
}

TEST(Gp2d12, StaysWithinTheDataSheet) {
  const auto curve = InfraredCurve::gp2d12();
  EXPECT_GE(curve.volts(0.8), 0.25);
  EXPECT_LE(curve.volts(0.8), 0.55);
  EXPECT_GE(curve.volts(0.1) - curve.volts(0.8), 1.75);
  EXPECT_LE(curve.volts(0.1) - curve.volts(0.8), 2.25);
}

TEST(Gp2d120, GoesThroughItsTable) {
  const auto curve = InfraredCurve::gp2d120();
  for (const Point p : {Point{0.06, 2.0},
                        {0.08, 1.5},
                        {0.10, 1.3},
                        {0.13, 1.0},
                        {0.16, 0.8},
                        {0.22, 0.6},
                        {0.30, 0.43}})
    EXPECT_NEAR(curve.volts(p.metres), p.volts, 0.06)
        << p.metres;  // V, the table is rounded to 0.1
}

TEST(InfraredCurve, InverseGivesBackTheDistance) {
  const auto table = InfraredCurve::table({{0.05, 2.35}, {0.1, 1.3}, {0.2, 0.7}, {0.4, 0.31}});
  for (const auto& curve : {InfraredCurve::gp2d12(), InfraredCurve::gp2d120(), table}) {
    const double span = curve.max_range() - curve.min_range();
    for (int i = 1; i < 50; ++i) {
      const double metres = curve.min_range() + span * i / 50;
      EXPECT_NEAR(curve.metres(curve.volts(metres)), metres, kRounding);
    }
  }
}

TEST(InfraredCurve, TableIsLinearBetweenItsPoints) {
  const auto curve = InfraredCurve::table({{0.1, 2.0}, {0.2, 1.0}, {0.4, 0.5}});
  EXPECT_NEAR(curve.volts(0.15), 1.5, kRounding);
  EXPECT_NEAR(curve.volts(0.3), 0.75, kRounding);
  EXPECT_NEAR(curve.metres(0.6), 0.36, kRounding);
}

TEST(InfraredCurve, NearSurfacesFoldBack) {
  const auto curve = InfraredCurve::gp2d12();
  EXPECT_NEAR(curve.volts(0.05), curve.volts(0.10) / 2, kRounding);
  EXPECT_EQ(curve.volts(0), 0);
  // 5 cm looks like a farther surface: the ambiguity of the real sensor.
  EXPECT_GT(curve.metres(curve.volts(0.05)), 0.2);
}

TEST(InfraredCurve, OutputFallsToTheFloorBeyondTheRange) {
  const auto curve = InfraredCurve::gp2d12();
  EXPECT_NEAR(curve.volts(1.0), curve.volts(0.8) * 0.8, kRounding);
  EXPECT_NEAR(curve.volts(curve.reach()), InfraredCurve::kFloorVolts, kRounding);
  EXPECT_EQ(curve.volts(10), InfraredCurve::kFloorVolts);
  EXPECT_EQ(curve.volts(kInfinity), InfraredCurve::kFloorVolts);
}

TEST(InfraredCurve, OutputsOutsideTheRangeAreNamed) {
  const auto curve = InfraredCurve::gp2d12();
  EXPECT_TRUE(std::isnan(curve.metres(curve.volts(1.0))));
  EXPECT_TRUE(std::isnan(curve.metres(0)));
  EXPECT_EQ(curve.metres(4.9), 0.10);
}

TEST(InfraredCurve, TablesThatAreNotCurvesAreRefused) {
  EXPECT_THROW(InfraredCurve::table({{0.1, 2.0}}), std::invalid_argument);
  EXPECT_THROW(InfraredCurve::table({{0.1, 2.0}, {0.1, 1.0}}), std::invalid_argument);
  EXPECT_THROW(InfraredCurve::table({{0.1, 2.0}, {0.2, 2.0}}), std::invalid_argument);
  EXPECT_THROW(InfraredCurve::table({{0, 2.0}, {0.2, 1.0}}), std::invalid_argument);
  EXPECT_THROW(InfraredCurve::table({{0.1, 2.0}, {0.2, 0.2}}), std::invalid_argument);
  EXPECT_THROW(InfraredCurve::table({{0.1, 2.0}, {0.2, kInfinity}}), std::invalid_argument);
}

TEST(Converter, RoundsToItsCounts) {
  const Converter converter{10, 5.0};
  const double count = 5.0 / 1023;
  EXPECT_NEAR(converter.quantise(100.4 * count), 100 * count, kRounding);
  EXPECT_NEAR(converter.quantise(100.6 * count), 101 * count, kRounding);
  EXPECT_EQ(converter.quantise(-1), 0);
  EXPECT_EQ(converter.quantise(7), 5);
  EXPECT_EQ((Converter{0, 5.0}.quantise(1.2345678)), 1.2345678);
}

}  // namespace
}  // namespace hal::node::devices
