#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "sim/radio/mac/mac_sap.h"

namespace baraka::run::network {

/// Bytes to read a frame from a TAP into: more than the Ethernet header and the largest payload, so
/// that longer frames are recognised.
inline constexpr std::size_t kFrameBuffer = 64 + 2 * sim::radio::kMaxMsdu;

/// A number of frames as RoomPage::publish() takes it.
inline std::uint32_t frame_count(std::size_t frames) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max() / 2;
  return static_cast<std::uint32_t>(std::min(frames, kMost));
}

}  // namespace baraka::run::network
