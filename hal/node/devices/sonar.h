#pragma once

#include <string_view>

#include "hal/node/devices/mount.h"
#include "hal/types/channel.h"
#include "hal/types/time.h"

namespace hal::node::devices {

/// An ultrasonic ranger: the nearest surface in a cone around a horizontal axis.
struct Sonar {
  static constexpr std::string_view kKind = "sonar";

  Mount mount{"sonar", {}, 0};  ///< The apex of the cone, and where its axis looks.
  double half_angle = 0;        ///< rad, > 0, < pi/2, between the axis and the cone's surface
  double min_range = 0;         ///< m, >= 0; what is nearer reads -infinity.
  double max_range = 0;         ///< m, > min_range; what is farther reads NaN.
  double resolution = 0;        ///< m, >= 0; ranges are multiples of it. 0: continuous.
  double noise_sigma = 0;       ///< m, >= 0, standard deviation of a range before it is rounded
  Duration period{};            ///< between two measurements; 0: it measures when asked.

  /// Kind "sonar", m: one range. The channel's headings are the two edges of the cone.
  Channel describe() const;

  /// What the sensor tells of a distance. @param metres  infinity: nothing there.
  /// @param noise  m, added. @return m, in min_range .. max_range, -infinity or NaN.
  double reading(double metres, double noise) const;

  bool operator==(const Sonar&) const = default;
};

}  // namespace hal::node::devices
