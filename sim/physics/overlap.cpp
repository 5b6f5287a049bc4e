#include "sim/physics/overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sim::physics {
namespace {

using hal::Vec2;

Vec2 turned(Vec2 v) { return {-v.y, v.x}; }

double between_cylinders(const Shape& a, const Shape& b) {
  const Vec2 apart = b.centre - a.centre;
  return a.radius + b.radius - std::sqrt(hal::dot(apart, apart));
}

double between_box_and_cylinder(const Shape& box, const Shape& cylinder) {
  const Vec2 to = cylinder.centre - box.centre;
  const double x = std::abs(hal::dot(to, box.axis)) - box.half.x;
  const double y = std::abs(hal::dot(to, turned(box.axis))) - box.half.y;
  if (x <= 0 && y <= 0) return cylinder.radius - std::max(x, y);  // to the nearest side
  const Vec2 outside{std::max(x, 0.0), std::max(y, 0.0)};
  return cylinder.radius - std::sqrt(hal::dot(outside, outside));
}

/// Half the length of a box's projection on a direction.
double shadow(const Shape& box, Vec2 direction) {
  return std::abs(hal::dot(box.axis, direction)) * box.half.x +
         std::abs(hal::dot(turned(box.axis), direction)) * box.half.y;
}

/// Convex shapes are apart if their projections on the normal of one of their sides are (S.
/// Gottschalk, M. C. Lin, D. Manocha, "OBBTree", SIGGRAPH 1996).
double between_boxes(const Shape& a, const Shape& b) {
  const Vec2 apart = b.centre - a.centre;
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2 normal : std::array{a.axis, turned(a.axis), b.axis, turned(b.axis)}) {
    least =
        std::min(least, shadow(a, normal) + shadow(b, normal) - std::abs(hal::dot(apart, normal)));
  }
  return least;
}

double seen_from_above(const Shape& a, const Shape& b) {
  const bool a_is_box = a.kind == Shape::Kind::kBox;
  const bool b_is_box = b.kind == Shape::Kind::kBox;
  if (a_is_box && b_is_box) return between_boxes(a, b);
  if (a_is_box) return between_box_and_cylinder(a, b);
  if (b_is_box) return between_box_and_cylinder(b, a);
  return between_cylinders(a, b);
}

}  // namespace

Overlap overlap(const Shape& a, const Shape& b) {
  return {.level = seen_from_above(a, b),
          .upright = std::min(a.z_high - b.z_low, b.z_high - a.z_low)};
}

}  // namespace sim::physics
