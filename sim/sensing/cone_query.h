#pragma once

#include <optional>

#include "hal/types/geometry.h"
#include "sim/physics/shape.h"
#include "sim/sensing/sector_query.h"

namespace sim::sensing {

/// Cone: all points within a range of an apex and within an angle of a horizontal axis.
struct Cone {
  hal::Vec3 apex;        ///< m, world frame
  hal::Vec2 axis{1, 0};  ///< Unit vector.
  hal::Vec2 half_angle;  ///< Its cosine and sine, both > 0.
  double range = 0;      ///< m, > 0
};

/// Distance from the apex to the nearest point of an upright shape in the cone; 0 if the apex is in
/// the shape; nullopt if the shape does not reach into the cone.
///
/// The nearest point of a shape beside the axis is at the axis's height; that of a shape above or
/// below it is on the nearer face. It remains to find the smallest distance in the convex set in
/// which the outline overlaps the cone's section at that height, a hyperbola. It is at the
/// outline's own nearest point, or at the first point of the hyperbola in the outline, found by
/// bisection to the last bit. A sphere is seen at the angle in the cone that is nearest to its
/// centre's.
std::optional<double> nearest(const Cone& cone, const physics::Shape& shape);

/// Smallest upright box around all cones with this apex and range, for any direction of the axis.
Region bounds(const Cone& cone);

}  // namespace sim::sensing
