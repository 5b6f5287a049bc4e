#pragma once

#include <cstdint>
#include <memory>

#include "hal/types/agent_id.h"
#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/radio/mac_sap.h"
#include "sim/radio/phy_mode.h"

namespace sim::radio {

enum class FrameType : std::uint8_t { kData, kRts, kCts, kAck };

/// What a frame says and how it is sent. Made once by its transmitter and shared, unchanged, by
/// everyone who receives it; codec.h turns it into bytes where bytes are needed.
struct Frame {
  /// Transmitter in the upper 16 bits, below it the number among the frames of that transmitter.
  std::uint64_t id = 0;
  FrameType type = FrameType::kData;
  hal::AgentId transmitter{};
  hal::AgentId receiver{};        ///< kEveryone: broadcast.
  hal::Duration duration{};       ///< Duration field: how long the exchange goes on after it.
  std::uint16_t sequence = 0;     ///< Data: 0..4095.
  bool retry = false;             ///< Data: sent before under this sequence number.
  hal::BitsPerSecond rate{};      ///< Of the MPDU.
  const PhyMode* mode = nullptr;  ///< How it is sent; outlives the frame. Null: read from bytes.
  std::uint32_t air_length = 0;   ///< MPDU with FCS, bits.
  hal::Duration airtime{};        ///< Preamble, PLCP header and MPDU.
  std::uint8_t priority = 0;      ///< Data.
  Ethertype ethertype = 0;        ///< Data.
  Payload payload{};              ///< Data.
  std::uint64_t tag = 0;          ///< Data: the client's.

  bool is_broadcast() const { return receiver == hal::kEveryone; }
};

using FramePtr = std::shared_ptr<const Frame>;

}  // namespace sim::radio
