#pragma once

#include <optional>
#include <span>

#include "hal/types/agent_id.h"
#include "hal/types/message.h"

namespace sim::radio {

inline constexpr std::size_t kAddressSize = 6;

/// Appends 02:00:00:00:hh:ll for agent hhll, ff:ff:ff:ff:ff:ff for everyone.
void put_address(hal::Bytes& out, hal::AgentId agent);

/// The agent whose address is in the first six bytes; nullopt for any other address. @pre there are
/// six bytes.
std::optional<hal::AgentId> get_address(std::span<const std::uint8_t> bytes);

/// Appends the six octets of a multicast address.
void put_group(hal::Bytes& out, std::uint64_t group);

/// The first six bytes as a 48-bit number, first octet most significant. @pre there are six bytes.
std::uint64_t get_group(std::span<const std::uint8_t> bytes);

/// Whether the address in the first six bytes is a group address (IEEE Std 802-2014, 8.2: the first
/// octet is odd).
inline bool is_group(std::span<const std::uint8_t> bytes) { return (bytes[0] & 1) != 0; }

/// Appends an integer as in 802.11 frames, least significant byte first.
void put_little_endian(hal::Bytes& out, std::uint64_t value, int bytes);
/// @pre count <= 8, and there are `count` bytes.
std::uint64_t get_little_endian(std::span<const std::uint8_t> bytes, std::size_t count);

}  // namespace sim::radio
