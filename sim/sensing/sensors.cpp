#include "sim/sensing/sensors.h"

#include "sim/sensing/battery.h"
#include "sim/sensing/bumper.h"
#include "sim/sensing/imu.h"
#include "sim/sensing/pose_sensor.h"
#include "sim/sensing/scan.h"
#include "sim/sensing/sonar.h"

namespace sim::sensing {

std::unique_ptr<hal::node::devices::Sensor> make_sensor(
    const hal::node::devices::SensorDescription& sensor, const SensorSite& site) {
  return std::visit([&](const auto& one) { return simulated(one, site); }, sensor);
}

}  // namespace sim::sensing
