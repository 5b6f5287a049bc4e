#include "hal/dds/udp_sender.h"

#include <fmt/core.h>

namespace hal::dds {

std::string UdpSender::text() const {
  return fmt::format("{}.{}.{}.{}:{}", address >> 24U, address >> 16U & 255U, address >> 8U & 255U,
                     address & 255U, port);
}

}  // namespace hal::dds
