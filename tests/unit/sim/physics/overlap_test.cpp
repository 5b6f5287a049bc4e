#include "sim/physics/overlap.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sim::physics {
namespace {

constexpr double kRounding = 1e-12;  // m
const double kHalfRoot = std::sqrt(0.5);

Shape cylinder(double x, double y, double radius, double low = 0, double high = 1) {
  Shape shape;
  shape.kind = Shape::Kind::kCylinder;
  shape.centre = {x, y};
  shape.radius = radius;
  shape.z_low = low;
  shape.z_high = high;
  return shape;
}

/// Upright, its own x along `axis`.
Shape box(double x, double y, hal::Vec2 half, hal::Vec2 axis = {1, 0}) {
  Shape shape;
  shape.centre = {x, y};
  shape.half = half;
  shape.axis = axis;
  shape.z_high = 1;
  return shape;
}

double level(const Shape& a, const Shape& b) { return overlap(a, b).level; }

TEST(Overlap, OfCylindersIsWhatTheirRadiiExceedTheirDistanceBy) {
  EXPECT_NEAR(overlap(cylinder(0, 0, 0.2), cylinder(0.3, 0.4, 0.4)).level, 0.1, kRounding);
  EXPECT_NEAR(overlap(cylinder(0, 0, 0.2), cylinder(0.3, 0.4, 0.3)).level, 0, kRounding);
  EXPECT_NEAR(overlap(cylinder(0, 0, 0.2), cylinder(0.3, 0.4, 0.2)).level, -0.1, kRounding);
}

TEST(Overlap, OfBodiesAboveOneAnotherIsThatOfTheirHeights) {
  const Overlap meet = overlap(cylinder(0, 0, 1, 0, 0.5), cylinder(0.5, 0, 1, 0.4, 2));
  EXPECT_NEAR(meet.upright, 0.1, kRounding);
  EXPECT_NEAR(meet.level, 1.5, kRounding);
  EXPECT_TRUE(meet.is_deeper_than(0.05));
  EXPECT_FALSE(meet.is_deeper_than(0.2));
  const Overlap above = overlap(cylinder(0, 0, 1, 0, 0.5), cylinder(0, 0, 1, 0.7, 2));
  EXPECT_NEAR(above.upright, -0.2, kRounding);
  EXPECT_FALSE(above.is_deeper_than(0));
}

TEST(Overlap, OfABoxAndACylinderIsMeasuredToTheNearestSideOrCorner) {
  const Shape wall = box(0, 0, {0.1, 5});
  EXPECT_NEAR(level(wall, cylinder(0.25, 3, 0.2)), 0.05, kRounding);
  EXPECT_NEAR(level(cylinder(0.25, 3, 0.2), wall), 0.05, kRounding);
  EXPECT_NEAR(level(wall, cylinder(0.04, 3, 0.2)), 0.26, kRounding) << "its middle is inside";
  EXPECT_NEAR(level(wall, cylinder(0.4, 5.4, 0.45)), -0.05, kRounding) << "0.5 m off the corner";
  EXPECT_NEAR(level(box(0, 0, {1, 1}, {kHalfRoot, kHalfRoot}), cylinder(2, 0, 0.6)),
              0.6 - (2 - std::sqrt(2.0)), kRounding);
}

TEST(Overlap, OfBoxesTurnedAgainstOneAnotherIsTheShortestWayOut) {
  const Shape square = box(0, 0, {1, 1});
  EXPECT_NEAR(level(square, box(1.9, 0, {1, 1})), 0.1, kRounding);
  const Shape diamond = box(2.4, 0, {1, 1}, {kHalfRoot, -kHalfRoot});
  EXPECT_NEAR(level(square, diamond), std::sqrt(2.0) - 1.4, kRounding);
  // Corner by corner: their shadows along x and y overlap, those along the diamond's sides do not.
  const Shape off = box(1.8, 1.8, {1, 1}, {kHalfRoot, kHalfRoot});
  EXPECT_LT(level(square, off), 0);
  EXPECT_EQ(level(square, off), level(off, square));
}

}  // namespace
}  // namespace sim::physics
