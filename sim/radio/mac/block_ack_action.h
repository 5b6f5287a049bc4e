#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <variant>

#include "hal/types/message.h"

namespace sim::radio {

// Bodies of the Block Ack action frames (IEEE Std 802.11-2020, 9.6.4), as values and as bytes.

/// An agreement with the immediate policy is asked for.
struct AddBlockAckRequest {
  std::uint8_t dialog_token = 0;
  std::uint8_t tid = 0;
  std::uint32_t window = 64;  ///< Buffer size, 1 .. 1023.
  std::uint16_t start = 0;    ///< First sequence number.
  bool operator==(const AddBlockAckRequest&) const = default;
};

struct AddBlockAckResponse {
  std::uint8_t dialog_token = 0;
  std::uint16_t status = 0;  ///< 0: accepted.
  std::uint8_t tid = 0;
  std::uint32_t window = 64;
  bool operator==(const AddBlockAckResponse&) const = default;
};

/// An agreement ends.
struct DeleteBlockAck {
  bool by_originator = false;
  std::uint8_t tid = 0;
  std::uint16_t reason = 0;
  bool operator==(const DeleteBlockAck&) const = default;
};

using BlockAckAction = std::variant<AddBlockAckRequest, AddBlockAckResponse, DeleteBlockAck>;

/// Reason code: the MPDUs belong to no agreement (9.4.1.7, UNKNOWN_BA).
inline constexpr std::uint16_t kReasonUnknownBlockAck = 38;

hal::Bytes encode(const BlockAckAction& action);
/// @return nullopt: another action, or truncated.
std::optional<BlockAckAction> decode_block_ack_action(std::span<const std::uint8_t> body);

}  // namespace sim::radio
