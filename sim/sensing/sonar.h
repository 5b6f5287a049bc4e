#pragma once

#include <memory>

#include "hal/node/devices/sensor.h"
#include "hal/node/devices/sonar.h"
#include "sim/sensing/sensor_site.h"

namespace sim::sensing {

/// An ultrasonic range sensor: the nearest surface of walls, motes and other robots in its cone,
/// exact except for noise and resolution. Every surface except the ground reflects, at any angle.
std::unique_ptr<hal::node::devices::Sensor> simulated(const hal::node::devices::Sonar& sonar,
                                                      const SensorSite& site);

}  // namespace sim::sensing
