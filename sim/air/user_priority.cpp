#include "sim/air/user_priority.h"

#include "sim/air/ethertypes.h"

namespace sim::air {

std::uint8_t user_priority(radio::Ethertype ethertype, std::span<const std::uint8_t> packet) {
  constexpr int kUpperThree = 5;
  if (packet.size() < 2) return 0;
  if (ethertype == kEthertypeIpv4) return static_cast<std::uint8_t>(packet[1] >> kUpperThree);
  if (ethertype != kEthertypeIpv6) return 0;
  // The traffic class follows the four bits of the version.
  const int traffic_class = (packet[0] & 0x0f) << 4 | packet[1] >> 4;
  return static_cast<std::uint8_t>(traffic_class >> kUpperThree);
}

}  // namespace sim::air
