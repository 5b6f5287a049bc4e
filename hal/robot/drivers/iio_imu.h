#pragma once

#include <filesystem>
#include <memory>

#include "hal/files/description/fields.h"
#include "hal/robot/drivers/sensor_choice.h"

namespace hal::robot::drivers {

/// Gyroscopes and accelerometers in Linux's Industrial I/O subsystem (Linux kernel,
/// Documentation/ABI/testing/sysfs-bus-iio): in_anglvel_x_raw … z and in_accel_x_raw … z, times
/// in_anglvel_scale [rad/s] and in_accel_scale [m/s^2], or one scale per axis.
struct IioImuSettings {
  std::filesystem::path folder;  ///< E.g. "/sys/bus/iio/devices/iio:device1".
  DeviceTimes times;
};

std::unique_ptr<SensorDriver> make_iio_imu(const IioImuSettings& settings);

/// Reads its keys in a robot's file, for a sensor of kind imu.
std::shared_ptr<const SensorChoice> iio_imu_keys(files::description::Fields& io,
                                                 const node::devices::SensorDescription* sensor);

}  // namespace hal::robot::drivers
