#include "sim/radio/mac/mac_address.h"

#include <algorithm>
#include <array>

namespace sim::radio {

void put_address(hal::Bytes& out, hal::AgentId agent) {
  if (agent == hal::kEveryone) {
    out.insert(out.end(), kAddressSize, 0xff);
    return;
  }
  const auto high = static_cast<std::uint8_t>(agent.value >> 8);
  const auto low = static_cast<std::uint8_t>(agent.value & 0xff);
  out.insert(out.end(), {0x02, 0, 0, 0, high, low});
}

std::optional<hal::AgentId> get_address(std::span<const std::uint8_t> bytes) {
  const auto is_ff = [](std::uint8_t byte) { return byte == 0xff; };
  if (std::all_of(bytes.begin(), bytes.begin() + kAddressSize, is_ff)) return hal::kEveryone;
  constexpr std::array<std::uint8_t, 4> kPrefix{0x02, 0, 0, 0};
  if (!std::equal(kPrefix.begin(), kPrefix.end(), bytes.begin())) return std::nullopt;
  return hal::AgentId{static_cast<std::uint16_t>(bytes[4] << 8 | bytes[5])};
}

void put_group(hal::Bytes& out, std::uint64_t group) {
  for (int shift = 40; shift >= 0; shift -= 8) {
    out.push_back(static_cast<std::uint8_t>(group >> shift));
  }
}

std::uint64_t get_group(std::span<const std::uint8_t> bytes) {
  std::uint64_t group = 0;
  for (std::size_t i = 0; i < kAddressSize; ++i) group = group << 8 | bytes[i];
  return group;
}

void put_little_endian(hal::Bytes& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

std::uint64_t get_little_endian(std::span<const std::uint8_t> bytes, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value |= static_cast<std::uint64_t>(bytes[i]) << (8 * i);
  return value;
}

}  // namespace sim::radio
