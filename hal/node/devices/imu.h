#pragma once

#include <string_view>

#include "hal/node/devices/mount.h"
#include "hal/types/channel.h"

namespace hal::node::devices {

/// Three gyroscopes and three accelerometers, along the axes of the mount.
struct ImuSensor {
  static constexpr std::string_view kKind = "imu";

  Mount mount{"imu", {}, 0};
  double gyro_sigma = 0;           ///< rad/s, >= 0, standard deviation of each rate
  double accelerometer_sigma = 0;  ///< m/s^2, >= 0, standard deviation of each acceleration

  /// Kind "imu": angular velocity x, y, z [rad/s], then specific force x, y, z [m/s^2] as a mean
  /// since the previous reading; at rest it equals gravity and points upwards.
  Channel describe() const;

  bool operator==(const ImuSensor&) const = default;
};

}  // namespace hal::node::devices
