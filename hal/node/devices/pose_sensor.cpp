#include "hal/node/devices/pose_sensor.h"

#include <string>

namespace hal::node::devices {

Channel PoseSensor::describe() const {
  Channel channel;
  channel.name = mount.name;
  channel.kind = std::string(kKind);
  channel.unit = "m, rad";
  channel.length = 3;
  channel.period = period;
  channel.frame = "world";
  return channel;
}

}  // namespace hal::node::devices
