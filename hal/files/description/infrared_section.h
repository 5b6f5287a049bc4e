#pragma once

#include <vector>

#include "hal/files/description/fields.h"
#include "hal/node/devices/robot_description.h"

namespace hal::files::description {

/// `infrared:` of a robot: `sensor`, what all have in common, and `mounts`, one per sensor, which
/// may deviate.
void infrared_keys(Fields& io, std::vector<node::devices::InfraredSensor>& sensors);

}  // namespace hal::files::description
