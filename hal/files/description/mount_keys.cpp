#include "hal/files/description/mount_keys.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "hal/files/description/names.h"

namespace hal::files::description {
namespace {

/// Channels of devices that are not in `sensors:`, topics of every robot, and the name of the
/// battery.
constexpr std::array<std::string_view, 11> kTaken{
    "localisation", "odometry",  "infrared", "infrared_volts", "odom",   "range",
    "cmd_vel",      "base_link", "base",     "emergency_stop", "battery"};

}  // namespace

void name_key(Fields& io, node::devices::Mount& mount) {
  const std::string usual = mount.name;
  io.text(
      {"name", "Name of the sensor, which is also that of its channel, topic and frame.", usual},
      mount.name);
  check_name(io, mount.name);
  if (mount.name != usual && std::ranges::find(kTaken, mount.name) != kTaken.end()) {
    io.mistake("name",
               "'" + mount.name + "' is the name of another channel or topic of every robot");
  }
}

void keys_of(Fields& io, node::devices::Mount& mount) {
  name_key(io, mount);
  io.vec3({"position", "Position of the sensor in the body frame, whose origin is on the ground.",
           "[-3.2 cm, 0 m, 18.2 cm]", "[0 m, 0 m, 0 m]"},
          "m", kOffset, mount.position);
  io.number({"heading", "Direction in which the sensor points; 0 is the body's x axis.", "180 deg"},
            "rad", kAngle, mount.heading);
}

}  // namespace hal::files::description
