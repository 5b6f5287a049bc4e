#include "hal/files/description/sensor_keys.h"

namespace hal::files::description {

void keys_of(Fields& io, node::devices::ImuSensor& c) {
  keys_of(io, c.mount);
  io.number({"gyro_sigma", "Standard deviation of each rate of turn.", "0.01 rad/s"}, "rad/s",
            {0, 100}, c.gyro_sigma);
  io.number({"accelerometer_sigma", "Standard deviation of each acceleration.", "0.05 m/s^2"},
            "m/s^2", {0, 1000}, c.accelerometer_sigma);
}

}  // namespace hal::files::description
