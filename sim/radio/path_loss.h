#pragma once

#include "hal/types/geometry.h"
#include "hal/types/quantity.h"

namespace sim::radio {

/// From one antenna to another. World frame, m.
struct Path {
  Path(const hal::Vec3& a, const hal::Vec3& b)
      : from(a), to(b), distance_squared(dot(b - a, b - a)) {}

  const hal::Vec3& from;
  const hal::Vec3& to;
  double distance_squared;  ///< m^2
};

/// A link of the chain of propagation: what is left of a power after the way. The first one gets
/// what the transmitter sends, each other one what the one before it left.
class PathLoss {
 public:
  virtual ~PathLoss() = default;

  /// @param power  mW, > 0. @return no more than that.
  virtual hal::Milliwatts after(hal::Milliwatts power, const Path& path) const = 0;

  /// At no greater distance, m, more than `least` is left of `power`; may be infinite.
  virtual double reach(hal::Milliwatts power, hal::Milliwatts least) const = 0;
};

}  // namespace sim::radio
