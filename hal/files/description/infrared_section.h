#pragma once

#include <vector>

#include "hal/files/description/fields.h"
#include "hal/node/devices/robot_description.h"

namespace hal::files::description {

/// `infrared:` of a robot: `sensor`, the common properties, and `mounts`, one per sensor, which may
/// override them.
void infrared_keys(Fields& io, std::vector<node::devices::InfraredSensor>& sensors);

}  // namespace hal::files::description
