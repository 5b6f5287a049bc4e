#pragma once

#include <string>
#include <vector>

#include "hal/files/config/mapping.h"
#include "hal/files/config/writer.h"
#include "hal/node/devices/robot_description.h"

namespace hal::files::description {

/// Where a part sits on the body and which way it points.
struct Mounting {
  Vec2 position;       ///< m, body frame
  double heading = 0;  ///< rad, body frame
};

/// `position: [x, y]`, or `distance` and `bearing` from the body's origin.
/// @param heading  key of the heading; absent: the bearing of the position.
Mounting read_mounting(config::Mapping& in, const config::Key& heading);

/// `infrared:` of a robot: `sensor`, what all have in common, and `mounts`, one per sensor, which
/// may deviate.
std::vector<node::devices::InfraredSensor> read_infrared(config::Mapping in);
void write_infrared(config::Writer& out, std::vector<node::devices::InfraredSensor> sensors);

}  // namespace hal::files::description
