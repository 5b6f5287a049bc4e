#pragma once

#include <cstdint>

#include "hal/exchange/ports.h"
#include "sim/agents/simulation_config.h"

namespace sim::agents {

/// Numbers of the channels that simulated agents offer.
inline constexpr std::uint16_t kLocalisation = 0;
inline constexpr std::uint16_t kOdometry = 1;       ///< Robots only, as
inline constexpr std::uint16_t kInfrared = 2;       ///< are these, if they have such sensors.
inline constexpr std::uint16_t kInfraredVolts = 3;  ///< As the converter saw it.

/// What an agent of that description offers to a controller, before there is a world.
/// @param agent  one of `config`. @throws std::invalid_argument  wheels that do not make a drive.
hal::exchange::AgentOffer offer_of(const AgentConfig& agent, const SimulationConfig& config);

}  // namespace sim::agents
