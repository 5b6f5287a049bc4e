#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "hal/types/time.h"

namespace controllers {

/// Message class of all messages between help_mote and help_robot.
inline constexpr std::string_view kHelpTopic = "help";

/// Meaning of a message. The paper has three booleans (Labella, Dietrich, Dressler, "Hybrid
/// simulation of Sensor and Actor Networks with BARAKA", 2009, section 6.2): ra and a of the robot,
/// ma of the mote.
enum class HelpWord : std::uint8_t {
  kHelp = 1,  ///< Mote to everyone: a robot is needed.
  kAsk,       ///< ra = true: request for the task, or confirmation that the robot is still coming.
  kGiveUp,    ///< ra = false
  kGrant,     ///< ma = true: the robot is in charge.
  kRefuse,    ///< ma = false
  kArrived,   ///< a = true
};

/// Encoding: one byte for the word, then max_hop in ms, four bytes, big-endian.
struct HelpMessage {
  HelpWord word = HelpWord::kHelp;
  /// Longest time that the robot expects to need for one hop; zero: not given. At most 49 days.
  hal::Duration max_hop{};
  bool operator==(const HelpMessage&) const = default;
};

inline constexpr std::size_t kHelpMessageSize = 5;

inline std::array<std::uint8_t, kHelpMessageSize> encode(const HelpMessage& message) {
  const auto ms = static_cast<std::uint32_t>(message.max_hop / std::chrono::milliseconds{1});
  const auto byte = [ms](int shift) { return static_cast<std::uint8_t>(ms >> shift); };
  return {static_cast<std::uint8_t>(message.word), byte(24), byte(16), byte(8), byte(0)};
}

/// nullopt if the bytes are not such a message.
inline std::optional<HelpMessage> decode(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != kHelpMessageSize) return std::nullopt;
  const auto word = static_cast<HelpWord>(bytes[0]);
  if (word < HelpWord::kHelp || word > HelpWord::kArrived) return std::nullopt;
  std::uint32_t ms = 0;
  for (const std::uint8_t byte : bytes.subspan(1)) ms = ms << 8U | byte;
  return HelpMessage{.word = word, .max_hop = std::chrono::milliseconds{ms}};
}

}  // namespace controllers
