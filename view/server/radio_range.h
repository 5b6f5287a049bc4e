#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "sim/agents/simulation_config.h"

namespace view::server {

/// Distance at which an agent's frames can still be received [m], without walls and fading. None:
/// unlimited.
std::optional<double> radio_range(const sim::agents::SimulationConfig& config,
                                  const sim::agents::AgentConfig& agent);

/// Pairs of addresses of agents that are in range of each other at their start poses.
std::vector<std::pair<std::int64_t, std::int64_t>> links_at_start(
    const sim::agents::SimulationConfig& config);

}  // namespace view::server
