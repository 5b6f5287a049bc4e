#pragma once

#include <optional>

#include "hal/types/geometry.h"
#include "sim/physics/shape.h"

namespace sim::sensing {

/// Horizontal sector: all points of a plane within a range and within an angle of a heading.
struct Sector {
  hal::Vec3 origin;       ///< m, world frame; z is the height of the plane
  double heading = 0;     ///< rad, of the middle
  double half_angle = 0;  ///< rad, 0 .. pi/2 exclusive
  double range = 0;       ///< m, > 0
};

/// Axis-aligned box. m
struct Region {
  hal::Vec3 low, high;
};

/// What a horizontal plane cuts out of a shape: of a sphere, a disc.
/// @pre z in z_low .. z_high.
physics::Shape slice(const physics::Shape& shape, double z);

/// Nearest point of convex, upright shapes in a sector, exactly and without iteration.
///
/// The points of a convex set within a distance rho of the origin form a convex set, so the
/// bearings under which the set is seen within rho form nested intervals: the range as a function
/// of bearing has one minimum. Over the sector it is therefore the nearest point of the shape if
/// that lies inside, else the nearer hit of the two edge rays.
class SectorQuery {
 public:
  /// @pre half_angle in 0 .. pi/2 exclusive, range > 0.
  explicit SectorQuery(const Sector& sector);

  /// The same without trigonometry. @param middle  unit vector. @param half_angle  its cosine, > 0,
  /// and its sine, >= 0. @param range  m, > 0.
  SectorQuery(const hal::Vec3& origin, hal::Vec2 middle, hal::Vec2 half_angle, double range);

  /// Distance to the shape within the sector; 0 if the origin is inside; nullopt if the shape does
  /// not reach into the sector.
  std::optional<double> nearest(const physics::Shape& shape) const;

  /// Smallest box around the sector; its height is 0.
  const Region& bounds() const { return bounds_; }

 private:
  bool contains_bearing(hal::Vec2 point) const;

  hal::Vec3 origin_;
  double range_;
  hal::Vec2 half_;                   ///< Cosine and sine of the half angle.
  hal::Vec2 middle_, left_, right_;  ///< Unit vectors.
  Region bounds_;
};

/// Unit vector at an angle from x. rad
hal::Vec2 unit(double heading);

/// Rotates `vector` by the angle whose cosine and sine are `turn`.
inline hal::Vec2 turned(hal::Vec2 vector, hal::Vec2 turn) {
  return {vector.x * turn.x - vector.y * turn.y, vector.x * turn.y + vector.y * turn.x};
}

/// Interval of a line inside a shape, in multiples of the line's direction.
struct Interval {
  double from = 0, to = 0;
};

/// The part of origin + t * direction, t real, inside a shape's outline seen from above; nullopt if
/// the line misses it. @param direction  any length > 0.
std::optional<Interval> inside(const physics::Shape& shape, hal::Vec2 origin, hal::Vec2 direction);

/// Vector from `origin` to the nearest point of a shape, seen from above; zero if `origin` is
/// inside.
hal::Vec2 to_nearest(const physics::Shape& shape, hal::Vec2 origin);

/// Range of a shape along a direction from an origin. m @param direction  unit vector.
Interval extent_along(const physics::Shape& shape, hal::Vec2 origin, hal::Vec2 direction);

}  // namespace sim::sensing
