#include "hal/description/mount_section.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "hal/description/fields.h"
#include "hal/description/names.h"

namespace hal::description {
namespace {

/// Channels of devices that are not in `sensors:`, topics that every robot has, and the name that
/// tells the one battery.
constexpr std::array<std::string_view, 11> kTaken{
    "localisation", "odometry",  "infrared", "infrared_volts", "odom",   "range",
    "cmd_vel",      "base_link", "base",     "emergency_stop", "battery"};

}  // namespace

void read_name(Mapping& in, devices::Mount& mount) {
  const std::string usual = mount.name;
  mount.name =
      in.text({"name", "Of the sensor's channel, topic and frame.", mount.name}, mount.name);
  if (!may_be_named(mount.name)) {
    in.mistake("name", "must be a letter, then letters, digits, '_' or '-'");
  } else if (mount.name != usual && std::ranges::find(kTaken, mount.name) != kTaken.end()) {
    in.mistake("name",
               "'" + mount.name + "' is the name of another channel or topic of every robot");
  }
}

void read_mount(Mapping& in, devices::Mount& mount) {
  read_name(in, mount);
  if (in.has("position"))
    mount.position =
        in.vec3({"position", "Of the sensor, seen from the body's origin on the ground.",
                 "[-3.2 cm, 0 m, 18.2 cm]", "[0 m, 0 m, 0 m]"},
                "m", kOffset);
  mount.heading =
      in.number({"heading", "Where the sensor looks; the body's x axis is 0.", "180 deg"}, "rad",
                kAngle, mount.heading);
}

void write_name(Writer& out, const devices::Mount& mount) { out.text("name", mount.name); }

void write_mount(Writer& out, const devices::Mount& mount) {
  write_name(out, mount);
  out.numbers("position", {mount.position.x, mount.position.y, mount.position.z}, "m");
  out.number("heading", mount.heading, "rad");
}

}  // namespace hal::description
