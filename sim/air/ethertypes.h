#pragma once

#include "hal/rtps/ip_packet.h"
#include "sim/radio/mac/mac_sap.h"

namespace sim::air {

/// Ethertypes that agents' interfaces carry (IANA, "IEEE 802 Numbers").
inline constexpr radio::Ethertype kEthertypeIpv4 = hal::rtps::kEthertypeIpv4;
inline constexpr radio::Ethertype kEthertypeArp = 0x0806;
inline constexpr radio::Ethertype kEthertypeIpv6 = hal::rtps::kEthertypeIpv6;

}  // namespace sim::air
