#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/devices/imu.h"

namespace hal::description {

/// An inertial measurement unit in `sensors:`.
void read(config::Mapping& in, devices::ImuSensor& imu);
void write(config::Writer& out, const devices::ImuSensor& imu);

}  // namespace hal::description
