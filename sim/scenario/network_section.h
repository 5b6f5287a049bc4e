#pragma once

#include <span>

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `network:` of a group: the interfaces of its agents.
void network_keys(Fields& io, std::span<agents::AgentConfig> agents);

/// Notes addresses that two agents have, and those of which some cannot reach others.
void check_networks(Mapping& in, const Scenario& scenario);

}  // namespace sim::scenario
