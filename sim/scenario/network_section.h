#pragma once

#include <span>

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `network:` of a group: the interfaces of its agents.
void read_network(hal::config::Mapping in, std::span<agents::AgentConfig> agents);
/// Nothing if they have none.
void write_network(hal::config::Writer& out, std::span<const agents::AgentConfig> agents);

/// Notes addresses that two agents have, and those of which some cannot reach others.
void check_networks(hal::config::Mapping& in, const Scenario& scenario);

}  // namespace sim::scenario
