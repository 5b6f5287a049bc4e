#pragma once

#include "hal/rtps/ip_packet.h"
#include "sim/air/ethertypes.h"

namespace sim::air {

using hal::rtps::FragmentKey;
using hal::rtps::IpAddress;
using hal::rtps::IpPacket;
using hal::rtps::Octets;
using hal::rtps::read_ip;
namespace protocol = hal::rtps::protocol;

}  // namespace sim::air
