#pragma once

#include "sim/physics/shape.h"

namespace sim::physics {

/// Depth of the overlap of two upright shapes. m; if either is <= 0, the shapes do not overlap.
struct Overlap {
  /// Shortest horizontal displacement that separates them. Below 0: they are apart by this distance
  /// or, for two boxes corner to corner, by more.
  double level = 0;
  double upright = 0;  ///< Overlap of their heights.

  bool is_deeper_than(double depth) const { return level > depth && upright > depth; }
};
Overlap overlap(const Shape& a, const Shape& b);

}  // namespace sim::physics
