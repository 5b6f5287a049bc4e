#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>

namespace sim::radio {

/// Most MPDUs that one Block Ack can acknowledge: with HE (IEEE Std 802.11ax-2021, 9.3.1.8.2).
inline constexpr std::size_t kLongestBitmap = 256;
inline constexpr std::uint32_t kShortBitmap = 64;

/// What a BlockAckReq or a compressed BlockAck says (IEEE Std 802.11-2020, 9.3.1.7 and 9.3.1.8).
struct BlockAckFields {
  std::uint8_t tid = 0;                    ///< Traffic identifier, 0 .. 7: the user priority.
  std::uint16_t start = 0;                 ///< Starting sequence number, 0 .. 4095.
  std::uint32_t length = 0;                ///< BlockAck: bits of the bitmap, 64 or 256.
  std::bitset<kLongestBitmap> received{};  ///< BlockAck: bit i is for sequence number start + i.
};

/// Bits of the bitmap for a window of so many MPDUs.
constexpr std::uint32_t bitmap_length(std::uint32_t window) {
  return window <= kShortBitmap ? kShortBitmap : static_cast<std::uint32_t>(kLongestBitmap);
}

}  // namespace sim::radio
