#pragma once

#include <limits>
#include <vector>

namespace results::report {

/// The range of the finite values that were added; of none, low > high.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value);
  /// The range extended by a margin of this share; never empty.
  Extent padded(double share) const;
  /// The same on a logarithmic scale: the share is one of the decades. @pre low > 0, or no values.
  Extent log_padded(double share) const;
};

/// A linear or logarithmic scale from values to pixels.
struct Axis {
  double low = 0, high = 1;  ///< Values at the ends of the axis. Logarithmic: both above 0.
  double from = 0, to = 1;   ///< Positions of the ends, px.
  bool is_log = false;
  /// Position in px. @pre is_drawable(value)
  double at(double value) const;
  /// Whether the value has a position: finite, and above 0 on a logarithmic scale.
  bool is_drawable(double value) const;
  /// Whether it is drawable and within low .. high.
  bool holds(double value) const;
};

/// Round numbers within `low` .. `high` that divide the axis into about `count` parts; their
/// distance is 1, 2 or 5 times a power of ten. @pre low < high, count > 0.
std::vector<double> ticks(double low, double high, int count);

/// Powers of ten within `low` .. `high`, about `count` of them at most; of less than two decades
/// also their double and fivefold. @pre 0 < low < high, count > 0.
std::vector<double> log_ticks(double low, double high, int count);

}  // namespace results::report
