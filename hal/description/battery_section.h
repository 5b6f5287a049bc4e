#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/devices/battery.h"

namespace hal::description {

/// A battery in `sensors:`.
void read(config::Mapping& in, devices::Battery& battery);
void write(config::Writer& out, const devices::Battery& battery);

}  // namespace hal::description
