#include "sim/sensing/sector_query.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "hal/types/math.h"
#include "hal/types/random.h"

namespace sim::sensing::test {
namespace {

using hal::Vec2;
using hal::math::kPi;
using physics::Shape;

constexpr int kPlacements = 3000;

Vec2 unit(double heading) { return {hal::math::cos(heading), hal::math::sin(heading)}; }
double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
double length(Vec2 a) { return std::sqrt(hal::dot(a, a)); }

Shape box(Vec2 centre, Vec2 half, double yaw) {
  Shape shape;
  shape.centre = centre;
  shape.half = half;
  shape.axis = unit(yaw);
  shape.z_high = 1;
  return shape;
}

Shape cylinder(Vec2 centre, double radius) {
  Shape shape;
  shape.kind = Shape::Kind::kCylinder;
  shape.centre = centre;
  shape.radius = radius;
  shape.z_high = 1;
  return shape;
}

std::array<Vec2, 4> corners(const Shape& s) {
  const Vec2 u = s.half.x * s.axis;
  const Vec2 v = s.half.y * Vec2{-s.axis.y, s.axis.x};
  return {s.centre + u + v, s.centre - u + v, s.centre - u - v, s.centre + u - v};
}

/// Along a ray from `o` to the wall a-b, solved as two linear equations.
std::optional<double> ray_to_edge(Vec2 o, Vec2 d, Vec2 a, Vec2 b) {
  const double det = cross(d, b - a);
  if (det == 0) return std::nullopt;
  const double t = cross(a - o, b - a) / det;
  const double s = cross(a - o, d) / det;
  if (t < 0 || s < 0 || s > 1) return std::nullopt;
  return t;
}

std::optional<double> ray_to_circle(Vec2 o, Vec2 d, const Shape& c) {
  const Vec2 m = o - c.centre;
  const double b = hal::dot(m, d);
  const double discriminant = b * b - hal::dot(m, m) + c.radius * c.radius;
  if (discriminant < 0) return std::nullopt;
  const double t = -b - std::sqrt(discriminant);
  if (t < 0) return std::nullopt;
  return t;
}

std::optional<double> ray(Vec2 o, Vec2 d, const Shape& shape) {
  if (shape.kind == Shape::Kind::kCylinder) return ray_to_circle(o, d, shape);
  std::optional<double> first;
  const auto c = corners(shape);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto hit = ray_to_edge(o, d, c[i], c[(i + 1) % 4]);
    if (hit && (!first || *hit < *first)) first = hit;
  }
  return first;
}

/// A fan of rays, both edges included: never below the truth.
std::optional<double> fan(const Sector& s, const Shape& shape, int rays) {
  std::optional<double> first;
  for (int i = 0; i < rays; ++i) {
    const double bearing = s.heading + s.half_angle * (2.0 * i / (rays - 1) - 1);
    const auto hit = ray({s.origin.x, s.origin.y}, unit(bearing), shape);
    if (hit && *hit <= s.range && (!first || *hit < *first)) first = hit;
  }
  return first;
}

/// Points of the outline, from `o`, at which the distance can be least: corners and feet of
/// perpendiculars, the disc's nearest point.
std::vector<Vec2> extreme_points(Vec2 o, const Shape& shape) {
  if (shape.kind == Shape::Kind::kCylinder) {
    const Vec2 m = shape.centre - o;
    return {(length(m) - shape.radius) / length(m) * m};
  }
  std::vector<Vec2> points;
  const auto c = corners(shape);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 edge = c[(i + 1) % 4] - c[i];
    const double foot = hal::dot(o - c[i], edge) / hal::dot(edge, edge);
    points.push_back(c[i] - o);
    if (foot > 0 && foot < 1) points.push_back(c[i] + foot * edge - o);
  }
  return points;
}

/// The minimum over a closed set of candidates: the extreme points inside the sector, and where the
/// edges of the sector meet the outline.
std::optional<double> candidates(const Sector& s, const Shape& shape) {
  const Vec2 o{s.origin.x, s.origin.y};
  std::optional<double> first;
  const auto offer = [&](double d) {
    if (d <= s.range && (!first || d < *first)) first = d;
  };
  for (const Vec2 p : extreme_points(o, shape)) {
    const double off = hal::math::wrap_angle(hal::math::atan2(p.y, p.x) - s.heading);
    if (std::abs(off) <= s.half_angle) offer(length(p));
  }
  for (const double side : {-1.0, 1.0})
    if (const auto hit = ray(o, unit(s.heading + side * s.half_angle), shape)) offer(*hit);
  return first;
}

bool is_inside(Vec2 o, const Shape& shape) {
  const Vec2 m = o - shape.centre;
  if (shape.kind == Shape::Kind::kCylinder) return length(m) <= shape.radius;
  return std::abs(hal::dot(m, shape.axis)) <= shape.half.x &&
         std::abs(cross(shape.axis, m)) <= shape.half.y;
}

struct Placement {
  Sector sector;
  Shape shape;
};

/// Boxes from motes to walls and cylinders, around the origin out to 2 m.
Placement place(hal::RandomStream& random) {
  const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  const Vec2 centre{between(-2, 2), between(-2, 2)};
  Placement p;
  p.shape = random.below(2) == 0 ? cylinder(centre, between(0.05, 0.4))
                                 : box(centre, {between(0.02, 1), between(0.02, 0.3)},
                                       between(-hal::math::kPi, hal::math::kPi));
  const double half_angle = random.below(2) == 0 ? 2.5 * hal::math::kPi / 180 : between(0.01, 1.2);
  // Half of the sectors look roughly at the shape, so that hits, edges and misses all happen often.
  const double towards = hal::math::atan2(centre.y, centre.x);
  const double heading = random.below(2) == 0 ? towards + between(-0.3, 0.3)
                                              : between(-hal::math::kPi, hal::math::kPi);
  p.sector = {{0, 0, 0.5}, heading, half_angle, between(0.5, 2)};
  return p;
}

TEST(SectorQuery, AgreesWithTheCandidatesOfTheClosedForm) {
  hal::RandomStream random(1, "placements");
  int hits = 0;
  int misses = 0;
  for (int i = 0; i < kPlacements; ++i) {
    const Placement p = place(random);
    if (is_inside({}, p.shape)) continue;
    const auto exact = SectorQuery(p.sector).nearest(p.shape);
    const auto expected = candidates(p.sector, p.shape);
    ASSERT_EQ(exact.has_value(), expected.has_value()) << "placement " << i;
    ++(exact ? hits : misses);
    // m: rounding; near a grazing hit the square root doubles the lost digits: sqrt(1e-16) * 1 m
    if (!exact) continue;
    EXPECT_NEAR(*exact, *expected, 1e-7) << "placement " << i;
  }
  EXPECT_GT(hits, 600);
  EXPECT_GT(misses, 600);
}

/// @return whether both saw the shape.
bool expect_fan_agrees(const Placement& p) {
  constexpr int kRays = 801;
  const auto exact = SectorQuery(p.sector).nearest(p.shape);
  const auto sampled = fan(p.sector, p.shape, kRays);
  // Between two rays, 2 a / 800 apart, a corner can hide; at a corner one of the two sides is met
  // at 45 degrees or flatter, so the fan is at most range * spacing farther. Factor 3: spare.
  const double slack = 3 * 2 * p.sector.half_angle / (kRays - 1) * p.sector.range;
  if (!sampled) {
    EXPECT_TRUE(!exact || *exact + slack > p.sector.range);
    return false;
  }
  EXPECT_TRUE(exact);
  const double range = exact.value_or(-1);
  EXPECT_LE(range, *sampled + 1e-7);
  EXPECT_NEAR(range, *sampled, 1e-7 + slack);
  return true;
}

TEST(SectorQuery, AgreesWithAFineFanOfRays) {
  hal::RandomStream random(2, "placements");
  int compared = 0;
  for (int i = 0; i < kPlacements; ++i) {
    SCOPED_TRACE(i);
    const Placement p = place(random);
    if (!is_inside({}, p.shape)) compared += expect_fan_agrees(p);
  }
  EXPECT_GT(compared, 600);
}

TEST(SectorQuery, NearestPointInsideTheSectorIsTheRange) {
  const SectorQuery query({{0, 0, 0.5}, 0, 0.1, 5});
  EXPECT_NEAR(*query.nearest(box({2, 0}, {0.5, 1}, 0)), 1.5, 1e-15);
  EXPECT_NEAR(*query.nearest(cylinder({2, 0.05}, 0.5)), std::sqrt(4.0025) - 0.5, 1e-15);
}

TEST(SectorQuery, ObliqueWallIsMetByTheNearerEdgeRay) {
  // The line x + y = 2 and a sector of +-0.1 rad about x: the upper edge ray meets it first, at
  // 2 / (cos 0.1 + sin 0.1).
  const SectorQuery query({{0, 0, 0.5}, 0, 0.1, 5});
  const double depth = 0.2;
  const double shift = 1 + depth / std::sqrt(2.0);
  const auto range = query.nearest(box({shift, shift}, {depth, 10}, hal::math::kPi / 4));
  EXPECT_NEAR(*range, 2 / (hal::math::cos(0.1) + hal::math::sin(0.1)), 1e-12);
}

TEST(SectorQuery, ShapesAboveOrBelowThePlaneAreNotSeen) {
  Shape mote = box({0.5, 0}, {0.025, 0.025}, 0);
  mote.z_high = 0.05;
  EXPECT_TRUE(SectorQuery({{0, 0, 0.04}, 0, 0.04, 1}).nearest(mote));
  EXPECT_FALSE(SectorQuery({{0, 0, 0.06}, 0, 0.04, 1}).nearest(mote));
}

TEST(SectorQuery, OriginInsideAShapeReadsZero) {
  const SectorQuery query({{0, 0, 0.5}, 0, 0.1, 5});
  EXPECT_EQ(query.nearest(box({0.1, 0.1}, {0.5, 0.5}, 0.3)), 0.0);
  EXPECT_EQ(query.nearest(cylinder({-0.1, 0}, 0.5)), 0.0);
}

TEST(SectorQuery, BoundsTouchTheSectorAndNothingMore) {
  // 60 degrees either side of +x: reaches x = r ahead, y = r sin 60, x = 0 at its tip.
  const SectorQuery query({{1, 2, 0}, 0, hal::math::kPi / 3, 2});
  EXPECT_NEAR(query.bounds().low.x, 1, 1e-15);
  EXPECT_NEAR(query.bounds().high.x, 3, 1e-15);
  EXPECT_NEAR(query.bounds().low.y, 2 - std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(query.bounds().high.y, 2 + std::sqrt(3.0), 1e-14);
}

}  // namespace
}  // namespace sim::sensing::test
