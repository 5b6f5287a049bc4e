#pragma once

#include <optional>

#include "hal/types/geometry.h"
#include "sim/physics/shape.h"
#include "sim/sensing/sector_query.h"

namespace sim::sensing {

/// All points within a range of an apex and within an angle of a horizontal axis.
struct Cone {
  hal::Vec3 apex;        ///< m, world frame
  hal::Vec2 axis{1, 0};  ///< unit vector
  hal::Vec2 half_angle;  ///< its cosine and sine, both > 0
  double range = 0;      ///< m, > 0
};

/// Distance from the apex to the nearest point of an upright shape in the cone, 0 if the apex is in
/// the shape; none if the cone does not reach it.
///
/// Of a shape that stands beside the axis, the nearest point is at the axis's height, of one above
/// or below it on the face that is nearer: what is left is to find the least distance in the
/// convex set where the outline and the cone's section at that height, a hyperbola, overlap. That
/// is the outline's own nearest point, or the first point of the hyperbola in the outline; the
/// latter by bisection, to the last bit.
std::optional<double> nearest(const Cone& cone, const physics::Shape& shape);

/// Smallest upright box around a cone of that range in any direction of its axis.
Region bounds(const Cone& cone);

}  // namespace sim::sensing
