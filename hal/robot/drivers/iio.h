#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hal/node/devices/robot_description.h"
#include "hal/robot/drivers/device_times.h"
#include "hal/robot/drivers/driver_choice.h"
#include "hal/robot/drivers/infrared.h"

namespace hal::robot::drivers {

/// Settings of sensors on an analog-to-digital converter in Linux's Industrial I/O subsystem.
struct IioSettings {
  std::filesystem::path folder;       ///< E.g. "/sys/bus/iio/devices/iio:device0".
  std::vector<std::string> channels;  ///< E.g. "voltage0", one per sensor of the robot.
  DeviceTimes times;
  bool operator==(const IioSettings&) const = default;
};

/// Infrared sensors on an analog-to-digital converter in Linux's Industrial I/O subsystem (Linux
/// kernel, Documentation/ABI/testing/sysfs-bus-iio): millivolts = (raw + offset) * scale, read from
/// in_<channel>_raw, and in_<channel>_scale and _offset or, if common to all channels of a type,
/// in_<type>_scale and _offset. The offset is optional.
/// @param robot  must have one infrared sensor per channel; their curves convert to metres.
std::unique_ptr<InfraredDriver> make_iio_infrared(const IioSettings& settings,
                                                  const DrivenRobot& robot);

/// Reads their keys in a robot's file; returns the choice that they describe.
std::shared_ptr<const DriverChoice<InfraredDriver>> iio_infrared_keys(
    files::description::Fields& io, const node::devices::RobotDescription& robot);

}  // namespace hal::robot::drivers
