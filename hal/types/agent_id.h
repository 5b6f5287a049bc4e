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
/// Destination of a message to whoever hears its sender: one broadcast, which nobody repeats.
inline constexpr AgentId kNeighbours{0xfffe};
/// Agents have the addresses 1 .. kLastAddress.
inline constexpr std::uint16_t kLastAddress = 0xfffd;

/// To several at once: kEveryone or kNeighbours.
constexpr bool is_broadcast(AgentId destination) { return destination >= kNeighbours; }

/// What kind of HAL object an agent's controller gets: Mote& or Robot&.
enum class AgentKind : std::uint8_t { kMote, kRobot };

}  // namespace hal
