#pragma once

#include <memory>

#include "hal/devices/battery.h"
#include "hal/devices/sensor.h"
#include "sim/sensing/sensor_site.h"

namespace sim::sensing {

/// A battery that the agent's motors, radio and computer empty from time 0 on. What they drew
/// between two readings counts as drawn evenly: exact without internal resistance and with the same
/// voltage full and empty.
std::unique_ptr<hal::devices::Sensor> simulated(const hal::devices::Battery& battery,
                                                const SensorSite& site);

}  // namespace sim::sensing
