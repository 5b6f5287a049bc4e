#pragma once

#include <vector>

#include "hal/node/exchange/ports.h"
#include "hal/types/channel.h"
#include "sim/agents/simulation_config.h"

namespace sim::agents {

/// What an agent with this description offers to a controller, before a world exists.
/// @param agent  one of `config`. @throws std::invalid_argument  its wheels do not make a drive.
hal::node::exchange::AgentOffer offer_of(const AgentConfig& agent, const SimulationConfig& config);

/// Its sensor channels: everything that it can read.
std::vector<hal::Channel> channels_of(const AgentConfig& agent);

}  // namespace sim::agents
