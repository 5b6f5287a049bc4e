#pragma once

#include <algorithm>

namespace results::report {

/// A linear scale from values to pixels.
struct Axis {
  double low = 0, high = 1;  ///< Values at the ends of the axis.
  double from = 0, to = 1;   ///< Positions of the ends, px.
  double at(double value) const { return from + (value - low) / (high - low) * (to - from); }
};

}  // namespace results::report
