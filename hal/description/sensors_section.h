#pragma once

#include <vector>

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/devices/sensors.h"

namespace hal::description {

/// `sensors:` of a robot or a mote: a list, each with its `kind` and the keys of that kind.
/// @param in  the robot's or mote's mapping.
std::vector<devices::SensorDescription> read_sensors(config::Mapping& in);
void write_sensors(config::Writer& out, const std::vector<devices::SensorDescription>& sensors);

}  // namespace hal::description
