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
  static constexpr bool kIsQuiet = true;  ///< For most of the time readings are equal.

  Mount mount{"scan", {}, 0};
  double field = 0;        ///< rad, > 0, at most a full turn; its centre is the mount's heading.
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

template <class Fields>
void keys_of(Fields& io, ScanSensor& c) {
  constexpr double kFullTurn = 6.2831853071795865;  // rad
  if (!io.is_writing()) {
    c.field = kFullTurn;
    c.rays = 360;
  }
  keys_of(io, c.mount);
  io.number(
      {"field",
       "Field of view: angle between the first and the last ray, half on each side of the heading.",
       "270 deg", "360 deg"},
      "rad", {0, kFullTurn}, c.field);
  io.count({"rays", "Number of rays, spread evenly over the field of view.", "360"}, 1, 10'000,
           c.rays);
  io.needed({"min_range", "Smallest distance that is measured.", "12 cm"}, "m", {0, 1000},
            c.min_range);
  io.needed({"max_range", "Largest distance that is measured.", "3.5 m"}, "m", {1e-3, 1000},
            c.max_range);
  io.number({"noise_sigma", "Standard deviation of the noise on a range.", "1 cm"}, "m", {0, 10},
            c.noise_sigma);
  io.duration({"period", "Time between two measurements; 0 s: a new measurement at each reading.",
               "200 ms"},
              {0, 10}, c.period);
  if (c.max_range <= c.min_range) io.mistake("max_range", "must be above min_range");
}

}  // namespace hal::node::devices
