#pragma once

#include <cstdint>

namespace sim::radio {

/// Sequence numbers of MPDUs count modulo this (IEEE Std 802.11-2020, 9.2.4.4.2).
inline constexpr std::uint16_t kSequenceNumbers = 4096;

/// Number of steps from one sequence number up to another, 0 .. 4095.
constexpr std::uint16_t steps(std::uint16_t from, std::uint16_t to) {
  return static_cast<std::uint16_t>((to - from) & (kSequenceNumbers - 1));
}
/// The number so many steps later.
constexpr std::uint16_t later(std::uint16_t number, std::uint32_t count) {
  return static_cast<std::uint16_t>((number + count) & (kSequenceNumbers - 1));
}
/// Whether a number so many steps ahead counts as old (10.25.6.3).
constexpr bool is_old(std::uint16_t steps_ahead) { return steps_ahead >= kSequenceNumbers / 2; }

}  // namespace sim::radio
