#pragma once

#include "sim/physics/shape.h"

namespace sim::physics {

/// How deep two upright shapes are in each other. m; where one is 0 or less they are apart.
struct Overlap {
  /// The shortest way that takes them apart on the ground. Below 0: they are apart by as much or,
  /// two boxes corner to corner, by more.
  double level = 0;
  double upright = 0;  ///< Of their heights.

  bool is_deeper_than(double depth) const { return level > depth && upright > depth; }
};
Overlap overlap(const Shape& a, const Shape& b);

}  // namespace sim::physics
