#pragma once

#include <memory>

#include "hal/node/devices/bumper.h"
#include "hal/node/devices/sensor.h"
#include "sim/sensing/sensor_site.h"

namespace sim::sensing {

/// Whether the body has had a contact in the physics steps since the previous reading.
std::unique_ptr<hal::node::devices::Sensor> simulated(const hal::node::devices::Bumper& bumper,
                                                      const SensorSite& site);

}  // namespace sim::sensing
