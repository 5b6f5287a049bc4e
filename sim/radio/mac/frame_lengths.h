#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/radio/mac/frame.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Length of an MPDU with FCS in bits. @param payload  data frames: bytes above LLC; management
/// frames: bytes of the frame body, after a header of 24 bytes (9.3.3.2).
/// IEEE Std 802.11-2016, 9.3.1 (RTS 20 bytes, CTS and ACK 14), 9.3.2 (data 24 + FCS 4); IEEE Std
/// 802.2-1998 and RFC 1042 (LLC/SNAP 8). With Lengths::kFixed, the config gives the length of data
/// frames.
/// IEEE Std 802.11-2020, 9.3.1.7.2: a compressed BlockAckReq has 24 bytes.
std::uint32_t mpdu_bits(const LengthsConfig& lengths, FrameType type, std::size_t payload = 0);

/// Length of a compressed BlockAck with a bitmap of so many bits (9.3.1.8.2).
std::uint32_t block_ack_bits(std::uint32_t length);

/// Length of the QoS Control field (9.2.4.5).
inline constexpr std::uint32_t kQosControlBits = 16;

}  // namespace sim::radio
