#pragma once

#include <memory>

#include "hal/node/devices/battery.h"
#include "hal/node/devices/sensor.h"
#include "sim/sensing/sensor_site.h"

namespace sim::sensing {

/// The gauge of the agent's battery, SensorSite::battery. Reading it changes nothing.
std::unique_ptr<hal::node::devices::Sensor> simulated(const hal::node::devices::Battery& battery,
                                                      const SensorSite& site);

}  // namespace sim::sensing
