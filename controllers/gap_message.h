#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "hal/types/agent_id.h"

namespace controllers {

/// Message class of what gap_mote and bridge_robot say about the network itself.
inline constexpr std::string_view kGapTopic = "gap";
/// … and of what motes tell the sink.
inline constexpr std::string_view kReportTopic = "report";

enum class GapWord : std::uint8_t {
  kSink = 1,  ///< Sink to everyone: who gets this can be reached, and reaches me.
  kCutOff,    ///< Mote to everyone: I hear nothing of the sink. `value`: reports per minute.
  kBid,       ///< Robot to everyone: what it is worth that I bridge the gap of `island`: `value`.
  kClaim,     ///< Robot to everyone: I do, or have done so.
};

/// On the air: the word, two bytes for the island, eight for the value (IEEE 754), the most
/// significant first.
struct GapMessage {
  GapWord word = GapWord::kSink;
  hal::AgentId island{};  ///< Motes that are cut off together, by the lowest address among them.
  double value = 0;
  bool operator==(const GapMessage&) const = default;
};

inline constexpr std::size_t kGapMessageSize = 11;

inline std::vector<std::uint8_t> encode(const GapMessage& message) {
  std::vector<std::uint8_t> bytes{static_cast<std::uint8_t>(message.word),
                                  static_cast<std::uint8_t>(message.island.value >> 8U),
                                  static_cast<std::uint8_t>(message.island.value)};
  const auto bits = std::bit_cast<std::uint64_t>(message.value);
  for (int shift = 56; shift >= 0; shift -= 8)
    bytes.push_back(static_cast<std::uint8_t>(bits >> static_cast<unsigned>(shift)));
  return bytes;
}

/// Nothing if the bytes are no such message.
inline std::optional<GapMessage> decode_gap(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != kGapMessageSize) return std::nullopt;
  GapMessage message;
  message.word = static_cast<GapWord>(bytes[0]);
  if (message.word < GapWord::kSink || message.word > GapWord::kClaim) return std::nullopt;
  message.island = hal::AgentId{static_cast<std::uint16_t>(bytes[1] << 8U | bytes[2])};
  std::uint64_t bits = 0;
  for (const std::uint8_t byte : bytes.subspan(3)) bits = bits << 8U | byte;
  message.value = std::bit_cast<double>(bits);
  return message;
}

}  // namespace controllers
