#pragma once

#include <string_view>

#include "hal/node/devices/mount.h"
#include "hal/types/channel.h"
#include "hal/types/time.h"

namespace hal::node::devices {

/// Pose of the body in the world: a compass with a position fix, by any method.
struct PoseSensor {
  static constexpr std::string_view kKind = "pose";

  Mount mount{"pose", {}, 0};  ///< Only its name is used.
  double position_sigma = 0;   ///< m, >= 0, standard deviation of x and of y
  double heading_sigma = 0;    ///< rad, >= 0
  Duration period{};           ///< Time between two fixes; 0: it measures when asked.

  /// Kind "pose": x, y [m] and heading [rad, (-pi, pi]] in the frame "world".
  Channel describe() const;

  bool operator==(const PoseSensor&) const = default;
};

}  // namespace hal::node::devices
