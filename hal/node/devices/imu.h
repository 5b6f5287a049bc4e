#pragma once

#include <array>
#include <string_view>

#include "hal/node/devices/mount.h"
#include "hal/node/devices/value_name.h"
#include "hal/types/channel.h"

namespace hal::node::devices {

/// Three gyroscopes and three accelerometers, along the axes of the mount.
struct ImuSensor {
  static constexpr std::string_view kKind = "imu";
  static constexpr std::array kValues{ValueName{"rate_x", "rad/s"},  ValueName{"rate_y", "rad/s"},
                                      ValueName{"rate_z", "rad/s"},  ValueName{"force_x", "m/s^2"},
                                      ValueName{"force_y", "m/s^2"}, ValueName{"force_z", "m/s^2"}};

  Mount mount{"imu", {}, 0};
  double gyro_sigma = 0;           ///< rad/s, >= 0, standard deviation of each rate
  double accelerometer_sigma = 0;  ///< m/s^2, >= 0, standard deviation of each acceleration

  /// Kind "imu": angular velocity x, y, z [rad/s], then specific force x, y, z [m/s^2] as a mean
  /// since the previous reading; at rest it equals gravity and points upwards.
  Channel describe() const;

  bool operator==(const ImuSensor&) const = default;
};

template <class Fields>
void keys_of(Fields& io, ImuSensor& c) {
  keys_of(io, c.mount);
  io.number({"gyro_sigma", "Standard deviation of the noise on each rate of turn.", "0.01 rad/s"},
            "rad/s", {0, 100}, c.gyro_sigma);
  io.number({"accelerometer_sigma", "Standard deviation of the noise on each acceleration.",
             "0.05 m/s^2"},
            "m/s^2", {0, 1000}, c.accelerometer_sigma);
}

}  // namespace hal::node::devices
