#pragma once

#include <variant>
#include <vector>

#include "hal/node/devices/battery.h"
#include "hal/node/devices/bumper.h"
#include "hal/node/devices/imu.h"
#include "hal/node/devices/pose_sensor.h"
#include "hal/node/devices/scan.h"
#include "hal/node/devices/sonar.h"
#include "hal/types/channel.h"

namespace hal::node::devices {

/// Every kind of sensor that `sensors:` of a robot file may list. Each type gives its name in
/// `kKind` and describes its channel; hal/files/description reads and writes it, and sim/sensing
/// simulates it.
using SensorDescription = std::variant<ScanSensor, PoseSensor, Bumper, ImuSensor, Battery, Sonar>;

inline Channel channel_of(const SensorDescription& sensor) {
  return std::visit([](const auto& one) { return one.describe(); }, sensor);
}

inline const Mount& mount_of(const SensorDescription& sensor) {
  return std::visit([](const auto& one) -> const Mount& { return one.mount; }, sensor);
}

/// The battery among the sensors; null: the agent has none and never runs out of energy.
inline const Battery* battery_of(const std::vector<SensorDescription>& sensors) {
  for (const SensorDescription& sensor : sensors)
    if (const auto* battery = std::get_if<Battery>(&sensor)) return battery;
  return nullptr;
}

}  // namespace hal::node::devices
