#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "sim/agents/simulation_config.h"

namespace view::server {

/// How far an agent's frames can be received, m, walls and fading apart; none: without limit.
std::optional<double> radio_range(const sim::agents::SimulationConfig& config,
                                  const sim::agents::AgentConfig& agent);

/// Pairs of addresses that hear each other where they stand at the start, as far as ranges tell.
std::vector<std::pair<std::int64_t, std::int64_t>> links_at_start(
    const sim::agents::SimulationConfig& config);

}  // namespace view::server
