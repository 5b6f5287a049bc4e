#pragma once

#include <memory>

#include "hal/node/devices/sensor.h"
#include "hal/node/devices/sonar.h"
#include "sim/sensing/sensor_site.h"

namespace sim::sensing {

/// An ultrasonic ranger: the nearest surface of walls, motes and other robots in its cone, exact
/// but for noise and resolution. Every surface answers, at any angle, but the ground.
std::unique_ptr<hal::node::devices::Sensor> simulated(const hal::node::devices::Sonar& sonar,
                                                      const SensorSite& site);

}  // namespace sim::sensing
