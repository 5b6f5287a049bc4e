#pragma once

#include <cstdint>
#include <span>

#include "sim/radio/mac/mac_sap.h"

namespace sim::air {

/// User priority of a packet, 0 .. 7: the upper three bits of its DSCP (RFC 2474), as Linux maps
/// them for frames without another mark (cfg80211_classify8021d() of 6.1). 0 for what is not IP.
std::uint8_t user_priority(radio::Ethertype ethertype, std::span<const std::uint8_t> packet);

}  // namespace sim::air
