#pragma once

#include <cstdint>

#include "sim/radio/mac/waiting_msdu.h"

namespace sim::radio {

/// A number that is the same for all MSDUs of one flow, and differs between flows: of IPv4 and IPv6
/// packets by addresses, protocol and, of TCP, UDP and the like, ports (IETF RFC 8290, 4.1.1),
/// fragments by addresses and protocol alone; of other frames by source, destination and ethertype.
/// @param seed  changes which flows have equal remainders.
std::uint64_t flow_hash(const WaitingMsdu& msdu, std::uint64_t seed);

}  // namespace sim::radio
