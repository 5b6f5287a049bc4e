#pragma once

#include <string_view>
#include <vector>

#include "hal/node/devices/mount.h"
#include "hal/types/channel.h"
#include "hal/types/time.h"

namespace hal::node::devices {

/// A planar laser scanner: rays in a horizontal plane, all measured at one instant.
struct ScanSensor {
  static constexpr std::string_view kKind = "scan";

  Mount mount{"scan", {}, 0};
  /// rad, > 0, at most a full turn; its centre is the mount's heading.
  double field = 0;
  int rays = 0;            ///< >= 1
  double min_range = 0;    ///< m, >= 0; nearer surfaces read -infinity.
  double max_range = 0;    ///< m, > min_range; farther surfaces read NaN.
  double noise_sigma = 0;  ///< m, >= 0, standard deviation of a range
  Duration period{};       ///< Time between two scans; 0: it measures when asked.

  /// Headings in the sensor's frame, rad, ascending. They include both ends of the field; for a
  /// full turn only the first end, because both are the same ray.
  std::vector<double> headings() const;

  /// Kind "scan", m: one range per ray, at its heading in the channel's frame.
  Channel describe() const;

  bool operator==(const ScanSensor&) const = default;
};

}  // namespace hal::node::devices
