#pragma once

#include <filesystem>
#include <memory>

#include "hal/config/mapping.h"
#include "hal/hardware/drivers/sensor_choice.h"

namespace hal::hardware {

/// A battery's gauge that Linux knows as a power supply (Linux kernel,
/// Documentation/ABI/testing/sysfs-class-power): `capacity` [%], `voltage_now` [uV] and
/// `current_now` [uA, negative or positive by the driver's taste: its absolute value is taken]. A
/// gauge without `current_now` gives not a number.
struct PowerSupplySettings {
  std::filesystem::path folder;  ///< E.g. "/sys/class/power_supply/BAT0".
  DeviceTimes times;
};

std::unique_ptr<SensorDriver> make_power_supply(const PowerSupplySettings& settings);

/// Its keys in a robot's file, of a sensor of the kind battery.
std::shared_ptr<const SensorChoice> read_power_supply(config::Mapping& in);

}  // namespace hal::hardware
