#pragma once

#include <string_view>

#include "hal/node/devices/mount.h"
#include "hal/types/channel.h"
#include "hal/types/time.h"

namespace hal::node::devices {

/// An ultrasonic ranger: the nearest surface in a cone around a horizontal axis.
struct Sonar {
  static constexpr std::string_view kKind = "sonar";

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

}  // namespace hal::node::devices
