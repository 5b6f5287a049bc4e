#include "sim/sensing/cone_query.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sim::sensing {
namespace {

using hal::Vec2;
using physics::Shape;

constexpr int kHalvings = 80;  // more than the bits of a double

/// A shape's outline and the cone's section at the height where they are nearest. In this frame the
/// apex is the origin and x is along the axis.
class ConeSection {
 public:
  ConeSection(const Cone& cone, const Shape& shape)
      : cone_(cone),
        shape_(shape),
        side_{-cone.axis.y, cone.axis.x},
        slope_(cone.half_angle.y / cone.half_angle.x),
        height_(std::clamp(cone.apex.z, shape.z_low, shape.z_high) - cone.apex.z) {}

  double distance() const;  ///< m; infinity if they do not overlap

 private:
  double slack(double x) const;
  double roomiest(double from, double to) const;

  Vec2 apex() const { return {cone_.apex.x, cone_.apex.y}; }

  const Cone& cone_;
  const Shape& shape_;
  Vec2 side_;
  double slope_;   ///< Tangent of the half angle.
  double height_;  ///< m, of the section above the axis
};

/// Half width of the cone at x minus the outline's distance from the axis there; concave in x.
double ConeSection::slack(double x) const {
  const auto chord = inside(shape_, apex() + x * cone_.axis, side_);
  if (!chord) return -std::numeric_limits<double>::infinity();
  const double half_width = std::sqrt(std::max(x * x * slope_ * slope_ - height_ * height_, 0.0));
  return half_width - std::max({0.0, chord->from, -chord->to});
}

/// Where slack is largest, or any x at which it is >= 0. Golden section search.
double ConeSection::roomiest(double from, double to) const {
  constexpr double kShare = 0.61803398874989485;
  double low = to - kShare * (to - from), high = from + kShare * (to - from);
  double at_low = slack(low), at_high = slack(high);
  for (int i = 0; i < kHalvings && at_low < 0 && at_high < 0; ++i) {
    if (at_low < at_high) {
      from = low;
      low = high;
      at_low = at_high;
      high = from + kShare * (to - from);
      at_high = slack(high);
    } else {
      to = high;
      high = low;
      at_high = at_low;
      low = to - kShare * (to - from);
      at_low = slack(low);
    }
  }
  return at_low >= at_high ? low : high;
}

double ConeSection::distance() const {
  const Vec2 nearest = to_nearest(shape_, apex());
  const Vec2 seen{hal::dot(cone_.axis, nearest), hal::dot(side_, nearest)};
  const double straight = seen.x * seen.x + seen.y * seen.y + height_ * height_;
  const double beside = seen.y * seen.y + height_ * height_;
  if (seen.x >= 0 && beside <= seen.x * seen.x * slope_ * slope_) return std::sqrt(straight);

  const Interval extent = extent_along(shape_, apex(), cone_.axis);
  const double from = std::max({extent.from, std::abs(height_) / slope_, 0.0});
  if (from > extent.to) return std::numeric_limits<double>::infinity();
  double outside = std::clamp(seen.x, from, extent.to);
  double within = slack(outside) >= 0 ? outside : roomiest(from, extent.to);
  if (slack(within) < 0) return std::numeric_limits<double>::infinity();
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::midpoint(outside, within);
    (slack(middle) >= 0 ? within : outside) = middle;
  }
  return within / cone_.half_angle.x;
}

/// The distance along a ray grows with its angle to the direction of the centre.
double distance_to_sphere(const Cone& cone, const Shape& sphere) {
  const double height = 0.5 * (sphere.z_low + sphere.z_high) - cone.apex.z;
  const Vec2 way = sphere.centre - Vec2{cone.apex.x, cone.apex.y};
  const double squared = hal::dot(way, way) + height * height;
  const double radius_squared = sphere.radius * sphere.radius;
  if (squared <= radius_squared) return 0;
  const double along = hal::dot(way, cone.axis);
  const double aside = std::sqrt(std::max(squared - along * along, 0.0));
  if (aside * cone.half_angle.x <= along * cone.half_angle.y)
    return std::sqrt(squared) - sphere.radius;
  // Along the nearest edge of the cone, in the plane of its axis and the centre.
  const double ahead = along * cone.half_angle.x + aside * cone.half_angle.y;
  const double miss = aside * cone.half_angle.x - along * cone.half_angle.y;
  if (ahead < 0 || miss > sphere.radius) return std::numeric_limits<double>::infinity();
  return ahead - std::sqrt(radius_squared - miss * miss);
}

}  // namespace

std::optional<double> nearest(const Cone& cone, const Shape& shape) {
  const double distance = shape.kind == Shape::Kind::kSphere ? distance_to_sphere(cone, shape)
                                                             : ConeSection(cone, shape).distance();
  if (distance > cone.range) return std::nullopt;
  return distance;
}

Region bounds(const Cone& cone) {
  const auto& [x, y, z] = cone.apex;
  const double rise = cone.range * cone.half_angle.y;
  return {{x - cone.range, y - cone.range, z - rise}, {x + cone.range, y + cone.range, z + rise}};
}

}  // namespace sim::sensing
