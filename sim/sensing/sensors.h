#pragma once

#include <memory>

#include "hal/node/devices/sensor.h"
#include "hal/node/devices/sensors.h"
#include "sim/sensing/sensor_site.h"

namespace sim::sensing {

/// A sensor of a simulated agent. @param site  what it refers to outlives the sensor.
std::unique_ptr<hal::node::devices::Sensor> make_sensor(
    const hal::node::devices::SensorDescription& sensor, const SensorSite& site);

}  // namespace sim::sensing
