#pragma once

#include <cstdint>
#include <span>

#include "hal/types/message.h"
#include "hal/types/result.h"
#include "sim/radio/frame.h"

namespace sim::radio {

/// MPDU with FCS as it would be on the air: IEEE Std 802.11-2016, 9.2 and 9.3, payload behind
/// LLC/SNAP (RFC 1042); the body of a management frame is as management.h makes it. Agent hhll has
/// the MAC address 02:00:00:00:hh:ll, everyone ff:ff:ff:ff:ff:ff or the frame's group. Data of an
/// ad hoc network has both DS bits 0 and the BSSID 02:00:00:00:00:00; in a BSS it has one of them,
/// and the address of the access point is the BSSID (table 9-26). The Duration field is in whole
/// microseconds, rounded up.
hal::Bytes encode(const Frame& frame);

/// The inverse. What is not in the bytes keeps its default: id, rate, airtime, priority, tag, and
/// the transmitter of CTS and ACK. air_length is that of the bytes.
/// Errors: kProtocol, naming what was seen and what was allowed.
hal::Result<Frame> decode(std::span<const std::uint8_t> mpdu);

/// CRC-32 of IEEE Std 802.3-2018, 3.2.9.
std::uint32_t frame_check_sequence(std::span<const std::uint8_t> bytes);

}  // namespace sim::radio
