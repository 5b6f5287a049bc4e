#pragma once

#include "sim/physics/shape.h"

namespace sim::physics {

/// How deep two upright shapes are in each other: the shortest way, level or straight up, that
/// takes them apart. m; 0 or less: they are apart, by no less than that if one is a cylinder, and
/// else by no less than that along the sides of one of them.
double overlap(const Shape& a, const Shape& b);

}  // namespace sim::physics
