#include "hal/node/devices/imu.h"

#include <string>

namespace hal::node::devices {

Channel ImuSensor::describe() const {
  Channel channel;
  channel.name = mount.name;
  channel.kind = std::string(kKind);
  channel.unit = "rad/s, m/s^2";
  channel.length = 6;
  channel.frame = mount.name;
  channel.position = mount.position;
  channel.heading = mount.heading;
  return channel;
}

}  // namespace hal::node::devices
