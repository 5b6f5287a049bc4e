#pragma once

#include <cstdint>
#include <span>

#include "hal/types/message.h"
#include "hal/types/result.h"
#include "sim/radio/mac/frame.h"

namespace sim::radio {

/// Encodes a frame as an MPDU with FCS: IEEE Std 802.11-2016, 9.2 and 9.3. Data payload follows
/// LLC/SNAP (RFC 1042); management.h encodes the bodies of management frames. Agent hhll has the
/// MAC address 02:00:00:00:hh:ll, everyone ff:ff:ff:ff:ff:ff or the frame's group. Data frames of
/// an ad hoc network have both DS bits 0 and the BSSID 02:00:00:00:00:00; in a BSS one of the bits
/// is set, and the BSSID is the address of the access point (table 9-26). The Duration field is in
/// whole microseconds, rounded up.
hal::Bytes encode(const Frame& frame);

/// The inverse of encode(). Fields that the bytes do not contain keep their defaults: id, rate,
/// airtime, priority, tag, and the transmitter of CTS and ACK. air_length is the length of the
/// bytes.
/// Errors: kProtocol; the message says what was seen and what was allowed.
hal::Result<Frame> decode(std::span<const std::uint8_t> mpdu);

/// Computes the CRC-32 of IEEE Std 802.3-2018, 3.2.9.
std::uint32_t frame_check_sequence(std::span<const std::uint8_t> bytes);

}  // namespace sim::radio
