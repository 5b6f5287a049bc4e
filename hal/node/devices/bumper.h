#pragma once

#include <string_view>

#include "hal/node/devices/mount.h"
#include "hal/types/channel.h"

namespace hal::node::devices {

/// A switch around the whole body that closes while it touches a wall, a mote or another robot.
struct Bumper {
  static constexpr std::string_view kKind = "bumper";

  Mount mount{"bumper", {}, 0};  ///< Only its name is used.

  /// Kind "bumper": 1 if anything was touched since the previous reading, otherwise 0.
  Channel describe() const;

  bool operator==(const Bumper&) const = default;
};

}  // namespace hal::node::devices
