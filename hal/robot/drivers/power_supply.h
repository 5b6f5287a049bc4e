#pragma once

#include <filesystem>
#include <limits>
#include <memory>

#include "hal/files/description/fields.h"
#include "hal/robot/drivers/sensor_choice.h"

namespace hal::robot::drivers {

/// A battery gauge that Linux presents as a power supply (Linux kernel,
/// Documentation/ABI/testing/sysfs-class-power): `capacity` [%], `voltage_now` [uV] and
/// `current_now` [uA, with a sign that depends on the kernel's driver: its absolute value is used].
/// Without `current_now` the current is NaN. The energy is that of `energy_now` and `energy_full`
/// [uWh]; without them the gauge is assumed to belong to a battery with the capacity in the robot's
/// file.
struct PowerSupplySettings {
  std::filesystem::path folder;  ///< E.g. "/sys/class/power_supply/BAT0".
  DeviceTimes times;
  double capacity = std::numeric_limits<double>::quiet_NaN();  ///< J, as in the robot's file.
};

std::unique_ptr<SensorDriver> make_power_supply(const PowerSupplySettings& settings);

/// Reads its keys in a robot's file, for a sensor of kind battery. @param sensor  null: unknown.
std::shared_ptr<const SensorChoice> power_supply_keys(
    files::description::Fields& io, const node::devices::SensorDescription* sensor);

}  // namespace hal::robot::drivers
