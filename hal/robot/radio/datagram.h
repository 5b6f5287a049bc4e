#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/types/agent_id.h"
#include "hal/types/message.h"

namespace hal::robot::radio {

/// The format of datagrams between daemons: ten bytes, big-endian, then a frame of the routing.
///
///   offset  0 …        4          5     6 … 7              8 … 9
///           "BRKA"     version 1  0     transmitter's address  length of the frame
///
/// A datagram with other contents there, or with another length, is not of this format.
inline constexpr std::size_t kDatagramHeader = 10;
/// Longest frame, in bytes: one MSDU (IEEE Std 802.11-2016, 9.2.4.7), as in the simulator.
inline constexpr std::size_t kMaxFrame = 2304;

/// @pre at most kMaxFrame bytes; aborts otherwise.
Bytes to_datagram(AgentId from, std::span<const std::uint8_t> frame);

/// A frame within the bytes of its datagram.
struct ReceivedFrame {
  AgentId from;
  std::span<const std::uint8_t> bytes;
};

/// nullopt if the datagram is malformed, or its transmitter's address is invalid (0 or kEveryone).
std::optional<ReceivedFrame> from_datagram(std::span<const std::uint8_t> datagram);

}  // namespace hal::robot::radio
