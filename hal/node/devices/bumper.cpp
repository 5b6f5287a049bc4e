#include "hal/node/devices/bumper.h"

#include <string>

namespace hal::node::devices {

Channel Bumper::describe() const {
  Channel channel;
  channel.name = mount.name;
  channel.kind = std::string(kKind);
  channel.unit = "1";
  channel.length = 1;
  channel.frame = "base";
  channel.high = 1;
  return channel;
}

}  // namespace hal::node::devices
