#include "sim/sensing/cone_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hal/types/math.h"
#include "hal/types/random.h"

/// The nearest point of a shape in a cone, against closed forms in the shape's outline that know
/// nothing of the search under test.
namespace sim::sensing::test {
namespace {

using hal::Vec2;
using hal::math::kPi;
using physics::Shape;

constexpr double kNowhere = std::numeric_limits<double>::infinity();
constexpr double kReach = 6;  // m
constexpr int kPlacements = 10'000;

Vec2 across(Vec2 a) { return {-a.y, a.x}; }

/// The plane of the face that is nearest to the axis, seen from the apex: x along the axis.
struct Face {
  Face(const Cone& cone, const Shape& shape)
      : sine(cone.half_angle.y),
        cosine(cone.half_angle.x),
        height(std::clamp(cone.apex.z, shape.z_low, shape.z_high) - cone.apex.z) {}

  bool holds(Vec2 p) const {
    return p.x >= 0 && p.x * sine >= std::sqrt(p.y * p.y + height * height) * cosine * (1 - 1e-12);
  }
  double distance(Vec2 p) const { return std::sqrt(hal::dot(p, p) + height * height); }

  double sine, cosine, height;
};

Vec2 seen(const Cone& cone, Vec2 world) {
  const Vec2 from_apex = world - Vec2{cone.apex.x, cone.apex.y};
  return {hal::dot(cone.axis, from_apex), hal::dot(across(cone.axis), from_apex)};
}

void offer_if_held(double& best, const Face& face, Vec2 point) {
  if (face.holds(point)) best = std::min(best, face.distance(point));
}

/// Corner, foot of the perpendicular, and where the segment's line meets the cone: the roots of
/// (x sine)^2 = (y^2 + height^2) cosine^2.
void offer_segment(double& best, const Face& face, Vec2 from, Vec2 to) {
  const Vec2 way = to - from;
  const auto offer_at = [&](double share) {
    if (share >= 0 && share <= 1) offer_if_held(best, face, from + share * way);
  };
  offer_at(0);
  offer_at(-hal::dot(from, way) / hal::dot(way, way));
  const double s = face.sine * face.sine, c = face.cosine * face.cosine;
  const double two = way.x * way.x * s - way.y * way.y * c;
  const double one = from.x * way.x * s - from.y * way.y * c;
  const double none = from.x * from.x * s - (from.y * from.y + face.height * face.height) * c;
  const double under_root = one * one - two * none;
  if (under_root < 0 || two == 0) return;
  for (const double sign : {-1.0, 1.0}) offer_at((-one + sign * std::sqrt(under_root)) / two);
}

bool is_over(const Shape& shape, Vec2 point) {
  const Vec2 to = point - shape.centre;
  if (shape.kind == Shape::Kind::kCylinder) return hal::dot(to, to) <= shape.radius * shape.radius;
  return std::abs(hal::dot(to, shape.axis)) <= shape.half.x &&
         std::abs(hal::dot(to, across(shape.axis))) <= shape.half.y;
}

/// What comes first on the axis's bearing, above or below it: the vertex of the hyperbola.
void offer_vertex(double& best, const Face& face, const Cone& cone, const Shape& shape) {
  const double x = std::abs(face.height) * face.cosine / face.sine;
  if (is_over(shape, Vec2{cone.apex.x, cone.apex.y} + x * cone.axis))
    best = std::min(best, std::sqrt(x * x + face.height * face.height));
}

double box_by_closed_form(const Cone& cone, const Shape& box) {
  const Face face(cone, box);
  double best = kNowhere;
  offer_vertex(best, face, cone, box);
  const Vec2 x = box.half.x * box.axis, y = box.half.y * across(box.axis);
  const std::array corners{seen(cone, box.centre + x + y), seen(cone, box.centre - x + y),
                           seen(cone, box.centre - x - y), seen(cone, box.centre + x - y)};
  for (std::size_t i = 0; i < 4; ++i) offer_segment(best, face, corners[i], corners[(i + 1) % 4]);
  return best <= kReach ? best : kNowhere;
}

/// Of a cylinder that the axis's height meets: its nearest point, or where an edge ray hits it.
double disc_by_closed_form(const Cone& cone, const Shape& disc) {
  const Face face(cone, disc);
  const Vec2 centre = seen(cone, disc.centre);
  double best = kNowhere;
  offer_vertex(best, face, cone, disc);
  const double away = std::sqrt(hal::dot(centre, centre));
  if (away > disc.radius) offer_if_held(best, face, (1 - disc.radius / away) * centre);
  for (const Vec2 edge : {Vec2{face.cosine, face.sine}, Vec2{face.cosine, -face.sine}}) {
    const double ahead = hal::dot(edge, centre), beside = hal::dot(across(edge), centre);
    const double half = disc.radius * disc.radius - beside * beside;
    if (half >= 0 && ahead >= std::sqrt(half)) best = std::min(best, ahead - std::sqrt(half));
  }
  return best <= kReach ? best : kNowhere;
}

/// Of any cylinder, bearing by bearing: on one, the cone begins where
/// rho^2 (cos^2 bearing - cos^2 half_angle) = height^2 cos^2 half_angle. Finer and finer round the
/// nearest one.
double disc_by_bearings(const Cone& cone, const Shape& disc) {
  const Face face(cone, disc);
  const Vec2 centre = seen(cone, disc.centre);
  const double half_angle = std::atan2(face.sine, face.cosine);
  double best = kNowhere, low = -half_angle, high = half_angle;
  for (int round = 0; round < 6; ++round) {
    constexpr int kSteps = 400;
    double where = 0, found = kNowhere;
    for (int i = 0; i <= kSteps; ++i) {
      const double bearing = std::clamp(low + (high - low) * i / kSteps, -half_angle, half_angle);
      const double cosine = std::cos(bearing);
      const double beside = centre.y * cosine - centre.x * std::sin(bearing);
      const double ahead = centre.x * cosine + centre.y * std::sin(bearing);
      const double half = disc.radius * disc.radius - beside * beside;
      const double room = cosine * cosine - face.cosine * face.cosine;
      if (half < 0 || room <= 0) continue;
      const double begin = std::max(
          {ahead - std::sqrt(half), std::abs(face.height) * face.cosine / std::sqrt(room), 0.0});
      if (begin > ahead + std::sqrt(half) || begin >= found) continue;
      found = begin;
      where = bearing;
    }
    if (found == kNowhere) break;
    best = std::min(best, std::sqrt(found * found + face.height * face.height));
    const double step = (high - low) / kSteps;
    low = where - 2 * step;
    high = where + 2 * step;
  }
  return best <= kReach ? best : kNowhere;
}

class Placements {
 public:
  double between(double low, double high) { return low + (high - low) * random_.uniform(); }

  Cone cone() {
    return {.apex = {between(-1, 1), between(-1, 1), between(0, 0.5)},
            .axis = unit(between(-hal::math::kPi, hal::math::kPi)),
            .half_angle = unit(between(0.02, 1.4)),
            .range = kReach};
  }
  /// @param beside  Whether the axis's height meets it.
  Shape shape(Shape::Kind kind, const Cone& cone, bool beside) {
    Shape shape;
    shape.kind = kind;
    shape.centre = {between(-5, 5), between(-5, 5)};
    shape.axis = unit(between(-hal::math::kPi, hal::math::kPi));
    shape.half = {between(0.01, 1), between(0.01, 1)};
    shape.radius = between(0.01, 1);
    shape.z_low = beside ? cone.apex.z - between(0, 1) : between(-1, 1.5);
    shape.z_high = beside ? cone.apex.z + between(0, 1) : shape.z_low + between(0.01, 0.5);
    return shape;
  }

 private:
  hal::RandomStream random_{1, "cones"};
};

int agree(double found, double expected, double tolerance) {
  if (expected == kNowhere) {
    EXPECT_EQ(found, kNowhere);
    return 0;
  }
  EXPECT_NEAR(found, expected, tolerance);  // m
  return 1;
}

TEST(ConeQuery, FindsBoxesAsTheClosedFormIn10000RandomPlacements) {
  Placements random;
  int hits = 0;
  for (int k = 0; k < kPlacements; ++k) {
    const Cone cone = random.cone();
    const Shape box = random.shape(Shape::Kind::kBox, cone, k % 2 == 0);
    SCOPED_TRACE(k);
    hits += agree(nearest(cone, box).value_or(kNowhere), box_by_closed_form(cone, box), 1e-7);
  }
  EXPECT_GT(hits, kPlacements / 10) << "the test looks at something";
}

TEST(ConeQuery, FindsCylindersAtItsHeightAsTheClosedFormIn10000RandomPlacements) {
  Placements random;
  int hits = 0;
  for (int k = 0; k < kPlacements; ++k) {
    const Cone cone = random.cone();
    const Shape disc = random.shape(Shape::Kind::kCylinder, cone, true);
    SCOPED_TRACE(k);
    hits += agree(nearest(cone, disc).value_or(kNowhere), disc_by_closed_form(cone, disc), 1e-7);
  }
  EXPECT_GT(hits, kPlacements / 10);
}

TEST(ConeQuery, FindsCylindersAboveAndBelowBearingByBearing) {
  Placements random;
  int hits = 0;
  for (int k = 0; k < 2000; ++k) {
    const Cone cone = random.cone();
    const Shape disc = random.shape(Shape::Kind::kCylinder, cone, false);
    SCOPED_TRACE(k);
    const double expected = disc_by_bearings(cone, disc);
    const double found = nearest(cone, disc).value_or(kNowhere);
    if (expected == kNowhere && found != kNowhere) {  // a sliver between two bearings
      Cone narrower = cone;
      narrower.half_angle = unit(std::atan2(cone.half_angle.y, cone.half_angle.x) - 0.02);
      EXPECT_FALSE(nearest(narrower, disc));
      continue;
    }
    hits += agree(found, expected, 1e-5);
  }
  EXPECT_GT(hits, 200);
}

TEST(ConeQuery, MissesWhatIsBehindOrOutOfReachOrBetweenAxisAndCone) {
  const Cone cone{
      .apex = {0, 0, 0.1}, .axis = {1, 0}, .half_angle = unit(hal::math::kPi / 6), .range = 2};
  Shape low;  // its top is 0.1 m below the axis, which the cone reaches 0.1 m / tan(30 deg) ahead
  low.half = {0.05, 0.05};
  const double reached = 0.1 * std::sqrt(3.0);
  low.centre = {reached - 0.06, 0};
  EXPECT_FALSE(nearest(cone, low));
  low.centre = {reached, 0};
  EXPECT_NEAR(nearest(cone, low).value_or(0), 0.2, 1e-12);
  low.centre = {-1, 0};
  EXPECT_FALSE(nearest(cone, low));
  low.centre = {2.06, 0};
  low.z_high = 0.2;
  EXPECT_FALSE(nearest(cone, low));
  low.centre = {0, 0};
  EXPECT_EQ(nearest(cone, low), 0.0) << "it is around the apex";
}

}  // namespace
}  // namespace sim::sensing::test
