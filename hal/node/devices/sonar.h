#pragma once

#include <string_view>

#include "hal/node/devices/mount.h"
#include "hal/types/channel.h"
#include "hal/types/time.h"

namespace hal::node::devices {

/// An ultrasonic ranger: the nearest surface in a cone around a horizontal axis.
struct Sonar {
  static constexpr std::string_view kKind = "sonar";
  static constexpr bool kIsQuiet = true;  ///< For most of the time readings are equal.

  Mount mount{"sonar", {}, 0};  ///< Apex of the cone and direction of its axis.
  double half_angle = 0;        ///< rad, > 0, < pi/2, between the axis and the cone's surface
  double min_range = 0;         ///< m, >= 0; nearer surfaces read -infinity.
  double max_range = 0;         ///< m, > min_range; farther surfaces read NaN.
  double resolution = 0;        ///< m, >= 0; ranges are multiples of it; 0: continuous.
  double noise_sigma = 0;       ///< m, >= 0, standard deviation of a range before rounding
  Duration period{};            ///< Time between two measurements; 0: it measures when asked.

  /// Kind "sonar", m: one range. The channel's headings are the two edges of the cone.
  Channel describe() const;

  /// Reading of the sensor for a true distance. @param metres  infinity: nothing in the cone.
  /// @param noise  m, added. @return m, in min_range .. max_range, -infinity or NaN.
  double reading(double metres, double noise) const;

  bool operator==(const Sonar&) const = default;
};

template <class Fields>
void keys_of(Fields& io, Sonar& c) {
  keys_of(io, c.mount);
  io.needed({"half_angle", "Half of the opening angle of the cone that the sensor sees.", "15 deg"},
            "rad", {1e-3, 1.5}, c.half_angle);
  io.needed({"min_range", "Smallest distance that is measured.", "2 cm"}, "m", {0, 1000},
            c.min_range);
  io.needed({"max_range", "Largest distance that is measured.", "4 m"}, "m", {1e-3, 1000},
            c.max_range);
  io.number(
      {"resolution", "Ranges are rounded to multiples of this; 0 m: unlimited resolution.", "3 mm"},
      "m", {0, 10}, c.resolution);
  io.number({"noise_sigma", "Standard deviation of the noise on a range.", "1 cm"}, "m", {0, 10},
            c.noise_sigma);
  io.duration(
      {"period", "Time between two measurements; 0 s: a new measurement at each reading.", "60 ms"},
      {0, 10}, c.period);
  if (c.max_range <= c.min_range) io.mistake("max_range", "must be above min_range");
}

}  // namespace hal::node::devices
