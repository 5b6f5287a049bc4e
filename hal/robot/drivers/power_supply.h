#pragma once

#include <filesystem>
#include <limits>
#include <memory>

#include "hal/files/description/fields.h"
#include "hal/robot/drivers/sensor_choice.h"

namespace hal::robot::drivers {

/// A battery's gauge that Linux knows as a power supply (Linux kernel,
/// Documentation/ABI/testing/sysfs-class-power): `capacity` [%], `voltage_now` [uV] and
/// `current_now` [uA, negative or positive by the driver's taste: its absolute value is taken]. A
/// gauge without `current_now` gives not a number. The energy is what `energy_now` and
/// `energy_full` [uWh] say; a gauge without them is taken to be of a battery with the capacity of
/// the robot's file.
struct PowerSupplySettings {
  std::filesystem::path folder;  ///< E.g. "/sys/class/power_supply/BAT0".
  DeviceTimes times;
  double capacity = std::numeric_limits<double>::quiet_NaN();  ///< J, as in the robot's file.
};

std::unique_ptr<SensorDriver> make_power_supply(const PowerSupplySettings& settings);

/// Its keys in a robot's file, of a sensor of the kind battery. @param sensor  null: unknown.
std::shared_ptr<const SensorChoice> power_supply_keys(
    files::description::Fields& io, const node::devices::SensorDescription* sensor);

}  // namespace hal::robot::drivers
