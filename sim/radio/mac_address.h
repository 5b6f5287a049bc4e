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

/// Integers as in 802.11 frames, least significant byte first.
void put_little_endian(hal::Bytes& out, std::uint64_t value, int bytes);
/// @pre count <= 8, and there are so many.
std::uint64_t get_little_endian(std::span<const std::uint8_t> bytes, std::size_t count);

}  // namespace sim::radio
