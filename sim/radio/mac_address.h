#pragma once

#include <optional>
#include <span>

#include "hal/types/agent_id.h"
#include "hal/types/message.h"

namespace sim::radio {

inline constexpr std::size_t kAddressSize = 6;

/// Appends 02:00:00:00:hh:ll of agent hhll, ff:ff:ff:ff:ff:ff of everyone.
void put_address(hal::Bytes& out, hal::AgentId agent);

/// The agent in the first six bytes; none: it is of another kind. @pre there are six.
std::optional<hal::AgentId> get_address(std::span<const std::uint8_t> bytes);

/// Appends the six octets of a multicast address.
void put_group(hal::Bytes& out, std::uint64_t group);

/// The 48 bits in the first six bytes, the first octet highest. @pre there are six.
std::uint64_t get_group(std::span<const std::uint8_t> bytes);

/// Of the first six bytes: for several at once (IEEE Std 802-2014, 8.2: the first octet is odd).
inline bool is_group(std::span<const std::uint8_t> bytes) { return (bytes[0] & 1) != 0; }

/// Integers as in 802.11 frames, least significant byte first.
void put_little_endian(hal::Bytes& out, std::uint64_t value, int bytes);
/// @pre count <= 8, and there are so many.
std::uint64_t get_little_endian(std::span<const std::uint8_t> bytes, std::size_t count);

}  // namespace sim::radio
