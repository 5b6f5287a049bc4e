#pragma once

#include "sim/radio/mac/mac_sap.h"

namespace sim::air {

/// Ethertypes that agents' interfaces carry (IANA, "IEEE 802 Numbers").
inline constexpr radio::Ethertype kEthertypeIpv4 = 0x0800;
inline constexpr radio::Ethertype kEthertypeArp = 0x0806;
inline constexpr radio::Ethertype kEthertypeIpv6 = 0x86dd;

}  // namespace sim::air
