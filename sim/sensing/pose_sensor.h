#pragma once

#include <memory>

#include "hal/node/devices/pose_sensor.h"
#include "hal/node/devices/sensor.h"
#include "sim/sensing/sensor_site.h"

namespace sim::sensing {

/// The body's pose with noise. Between two fixes, the last one is held.
std::unique_ptr<hal::node::devices::Sensor> simulated(const hal::node::devices::PoseSensor& sensor,
                                                      const SensorSite& site);

}  // namespace sim::sensing
