#pragma once

#include <array>
#include <string_view>

#include "hal/node/devices/mount.h"
#include "hal/node/devices/value_name.h"
#include "hal/types/channel.h"

namespace hal::node::devices {

/// A switch around the whole body that closes while it touches a wall, a mote or another robot.
struct Bumper {
  static constexpr std::string_view kKind = "bumper";
  static constexpr std::array kValues{ValueName{"touched", "1"}};
  static constexpr bool kIsQuiet = true;  ///< For most of the time readings are equal.

  Mount mount{"bumper", {}, 0};  ///< Only its name is used.

  /// Kind "bumper": 1 if anything was touched since the previous reading, otherwise 0.
  Channel describe() const;

  bool operator==(const Bumper&) const = default;
};

template <class Fields>
void keys_of(Fields& io, Bumper& c) {
  name_key(io, c.mount);
}

}  // namespace hal::node::devices
