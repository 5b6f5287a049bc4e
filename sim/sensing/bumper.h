#pragma once

#include <memory>

#include "hal/devices/bumper.h"
#include "hal/devices/sensor.h"
#include "sim/sensing/sensor_site.h"

namespace sim::sensing {

/// Whether the body touched anything in the physics steps since the reading before.
std::unique_ptr<hal::devices::Sensor> simulated(const hal::devices::Bumper& bumper,
                                                const SensorSite& site);

}  // namespace sim::sensing
