#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "hal/types/agent_id.h"

namespace controllers {

/// Message class of the messages of gap_mote and bridge_robot about the network itself.
inline constexpr std::string_view kGapTopic = "gap";
/// Message class of the motes' reports to the sink.
inline constexpr std::string_view kReportTopic = "report";

enum class GapWord : std::uint8_t {
  kSink = 1,  ///< Sink to everyone: a receiver is connected to the sink.
  kCutOff,    ///< Mote to everyone: it no longer hears the sink. `value`: reports per minute.
  kBid,       ///< Robot to everyone: bid for bridging the gap of `island`. `value`: its worth.
  kClaim,     ///< Robot to everyone: it bridges that gap, or is on its way there.
};

/// Encoding: the word, two bytes for the island, eight for the value (IEEE 754), big-endian.
struct GapMessage {
  GapWord word = GapWord::kSink;
  hal::AgentId island{};  ///< Lowest address in a group of motes that are cut off together.
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

/// nullopt if the bytes are not such a message.
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
