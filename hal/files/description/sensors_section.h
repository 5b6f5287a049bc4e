#pragma once

#include <vector>

#include "hal/files/description/fields.h"
#include "hal/node/devices/sensors.h"

namespace hal::files::description {

/// `sensors:` of a robot or a mote: a list, each with its `kind` and the keys of that kind.
void sensor_keys(Fields& io, std::vector<node::devices::SensorDescription>& sensors);

}  // namespace hal::files::description
