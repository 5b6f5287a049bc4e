#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hal {

/// Priority of a message on the air: the user priority of IEEE Std 802.1D, which 802.11 carries as
/// the traffic identifier. Any number from 0 to 7, Priority{7}; the names are those of the access
/// categories, each with the number that stands for it. In ascending order of precedence: 1 and 2
/// background, 0 and 3 best effort, 4 and 5 video, 6 and 7 voice (IEEE Std 802.11-2020, table
/// 10-1).
enum class Priority : std::uint8_t { kBestEffort = 0, kBackground = 1, kVideo = 5, kVoice = 6 };

inline constexpr std::uint8_t kHighestPriority = 7;
inline constexpr std::size_t kPriorities = kHighestPriority + 1;
inline constexpr std::size_t kAccessCategories = 4;

constexpr std::uint8_t to_number(Priority priority) { return static_cast<std::uint8_t>(priority); }

/// Access category of a priority, in ascending order of precedence: 0 background, 1 best effort, 2
/// video, 3 voice.
constexpr std::size_t access_category(Priority priority) {
  constexpr std::array<std::size_t, kPriorities> kOfPriority{1, 0, 0, 1, 2, 2, 3, 3};
  return kOfPriority[to_number(priority) % kPriorities];
}

/// Differentiated services code point of a priority: class selector of the same number, CS0 to CS7
/// (RFC 2474, 4.2.2). Linux takes the user priority of a packet from these three bits.
constexpr std::uint8_t dscp_of(Priority priority) {
  constexpr int kBitsBelow = 3;
  return static_cast<std::uint8_t>(to_number(priority) << kBitsBelow);
}

/// How a message is sent.
struct SendOptions {
  Priority priority = Priority::kBestEffort;  ///< Of the message, at its sender and at all relays.
  bool operator==(const SendOptions&) const = default;  ///< Member by member.
};

}  // namespace hal
