#pragma once

#include <array>
#include <string_view>

#include "hal/node/devices/mount.h"
#include "hal/node/devices/value_name.h"
#include "hal/types/channel.h"
#include "hal/types/time.h"

namespace hal::node::devices {

/// Pose of the body in the world: a compass with a position fix, by any method.
struct PoseSensor {
  static constexpr std::string_view kKind = "pose";
  static constexpr std::array kValues{ValueName{"x", "m"}, ValueName{"y", "m"},
                                      ValueName{"yaw", "rad"}};

  Mount mount{"pose", {}, 0};  ///< Only its name is used.
  double position_sigma = 0;   ///< m, >= 0, standard deviation of x and of y
  double heading_sigma = 0;    ///< rad, >= 0
  Duration period{};           ///< Time between two fixes; 0: it measures when asked.

  /// Kind "pose": x, y [m] and heading [rad, (-pi, pi]] in the frame "world".
  Channel describe() const;

  bool operator==(const PoseSensor&) const = default;
};

template <class Fields>
void keys_of(Fields& io, PoseSensor& c) {
  name_key(io, c.mount);
  io.number({"position_sigma", "Standard deviation of the noise on x and on y.", "5 cm"}, "m",
            {0, 1000}, c.position_sigma);
  io.number({"heading_sigma", "Standard deviation of the noise on the heading.", "2 deg"}, "rad",
            {0, 10}, c.heading_sigma);
  io.duration(
      {"period", "Time between two measurements; 0 s: a new measurement at each reading.", "1 s"},
      {0, 10}, c.period);
}

}  // namespace hal::node::devices
