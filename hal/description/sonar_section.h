#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/devices/sonar.h"

namespace hal::description {

/// An ultrasonic ranger in `sensors:`.
void read(config::Mapping& in, devices::Sonar& sonar);
void write(config::Writer& out, const devices::Sonar& sonar);

}  // namespace hal::description
