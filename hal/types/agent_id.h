#pragma once

#include <compare>
#include <cstdint>

namespace hal {

/// 16-bit network address of an agent, the same in the simulator and on hardware.
/// Names are for people; addresses order events and travel in packets.
struct AgentId {
  std::uint16_t value = 0;  ///< 1 .. kLastAddress for an agent; 0: no agent.
  constexpr auto operator<=>(const AgentId&) const = default;  ///< Member by member.
};

/// Destination of a message that floods the whole network. Never the address of an agent.
inline constexpr AgentId kEveryone{0xffff};
/// Destination of a message to all neighbours of its sender: one broadcast that is never forwarded.
inline constexpr AgentId kNeighbours{0xfffe};
/// Agents have the addresses 1 .. kLastAddress.
inline constexpr std::uint16_t kLastAddress = 0xfffd;

/// Whether a destination is kEveryone or kNeighbours rather than one agent.
constexpr bool is_broadcast(AgentId destination) { return destination >= kNeighbours; }

/// Which object of the API the controller of an agent gets.
enum class AgentKind : std::uint8_t {
  kMote,  ///< hal::Mote: it has a radio and sensors but no drive.
  kRobot  ///< hal::Robot: it can also drive.
};

}  // namespace hal
