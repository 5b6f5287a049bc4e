#include "gateway/guard/udp_sender.h"

#include <fmt/core.h>

namespace gateway::guard {

std::string UdpSender::text() const {
  return fmt::format("{}.{}.{}.{}:{}", address >> 24U, address >> 16U & 255U, address >> 8U & 255U,
                     address & 255U, port);
}

}  // namespace gateway::guard
