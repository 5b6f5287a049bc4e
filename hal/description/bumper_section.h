#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/devices/bumper.h"

namespace hal::description {

/// A bumper in `sensors:`.
void read(config::Mapping& in, devices::Bumper& bumper);
void write(config::Writer& out, const devices::Bumper& bumper);

}  // namespace hal::description
