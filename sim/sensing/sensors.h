#pragma once

#include <memory>

#include "hal/node/devices/sensor.h"
#include "hal/node/devices/sensors.h"
#include "sim/sensing/sensor_site.h"

namespace sim::sensing {

/// Makes a sensor of a simulated agent. @param site  the objects that it refers to outlive the
/// sensor.
std::unique_ptr<hal::node::devices::Sensor> make_sensor(
    const hal::node::devices::SensorDescription& sensor, const SensorSite& site);

}  // namespace sim::sensing
