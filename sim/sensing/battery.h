#pragma once

#include <memory>

#include "hal/devices/battery.h"
#include "hal/devices/sensor.h"
#include "sim/sensing/sensor_site.h"

namespace sim::sensing {

/// The gauge of the agent's battery, which SensorSite::battery shows. Reading it changes nothing.
std::unique_ptr<hal::devices::Sensor> simulated(const hal::devices::Battery& battery,
                                                const SensorSite& site);

}  // namespace sim::sensing
