#pragma once

#include <compare>
#include <cstdint>

namespace hal {

/// 16-bit network address of an agent, the same in the simulator and on hardware.
/// Names are for people; addresses order events and travel in packets.
struct AgentId {
  std::uint16_t value = 0;
  constexpr auto operator<=>(const AgentId&) const = default;
};

/// Destination of a message that floods the whole network. Never the address of an agent.
inline constexpr AgentId kEveryone{0xffff};

/// What kind of HAL object an agent's controller gets: Mote& or Robot&.
enum class AgentKind : std::uint8_t { kMote, kRobot };

}  // namespace hal
