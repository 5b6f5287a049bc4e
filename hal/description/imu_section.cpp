#include "hal/description/imu_section.h"

#include "hal/description/fields.h"
#include "hal/description/mount_section.h"

namespace hal::description {
namespace {

template <class Io>
void imu_keys(Io& io, devices::ImuSensor& c) {
  io.number({"gyro_sigma", "Standard deviation of each rate of turn.", "0.01 rad/s"}, "rad/s",
            {0, 100}, c.gyro_sigma);
  io.number({"accelerometer_sigma", "Standard deviation of each acceleration.", "0.05 m/s^2"},
            "m/s^2", {0, 1000}, c.accelerometer_sigma);
}

}  // namespace

void read(Mapping& in, devices::ImuSensor& imu) {
  read_mount(in, imu.mount);
  FieldReader reader(in);
  imu_keys(reader, imu);
}

void write(Writer& out, const devices::ImuSensor& imu) {
  devices::ImuSensor copy = imu;
  FieldWriter writer(out);
  write_mount(out, imu.mount);
  imu_keys(writer, copy);
}

}  // namespace hal::description
