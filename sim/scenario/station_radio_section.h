#pragma once

#include <span>

#include "sim/agents/simulation_config.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {

/// `radio:` of a group of agents: settings of their radios that differ from the network's, and
/// `overrides` for some agents.
void station_radio_key(Fields& io, std::span<agents::AgentConfig> agents,
                       const radio::RadioConfig& config);

}  // namespace sim::scenario
