#pragma once

#include <span>

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "sim/agents/simulation_config.h"

namespace sim::scenario {

/// `radio:` of a group of agents: what their radios have of their own, and `overrides` for some.
void read_station_radios(hal::config::Mapping in, const radio::RadioConfig& config,
                         std::span<agents::AgentConfig> agents);
void write_station_radios(hal::config::Writer& out, std::span<const agents::AgentConfig> agents);

}  // namespace sim::scenario
