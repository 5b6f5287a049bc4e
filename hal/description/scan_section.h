#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/devices/scan.h"

namespace hal::description {

/// A laser scanner in `sensors:`.
void read(config::Mapping& in, devices::ScanSensor& scan);
void write(config::Writer& out, const devices::ScanSensor& scan);

}  // namespace hal::description
