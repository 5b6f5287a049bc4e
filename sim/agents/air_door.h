#pragma once

#include <string>
#include <string_view>

namespace sim::agents {

inline constexpr std::string_view kAirDoorPrefix = "air of ";

/// The door by which the frames of an agent's programs come in.
inline std::string air_door(std::string_view agent) {
  return std::string(kAirDoorPrefix) + std::string(agent);
}
inline bool is_air_door(std::string_view door) { return door.starts_with(kAirDoorPrefix); }

}  // namespace sim::agents
