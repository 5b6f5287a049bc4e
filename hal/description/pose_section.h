#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/devices/pose_sensor.h"

namespace hal::description {

/// A source of poses in `sensors:`.
void read(config::Mapping& in, devices::PoseSensor& pose);
void write(config::Writer& out, const devices::PoseSensor& pose);

}  // namespace hal::description
