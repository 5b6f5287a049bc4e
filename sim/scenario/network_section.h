#pragma once

#include <span>

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `network:` of a group: the interfaces of its agents.
void network_keys(Fields& io, Group& group, std::span<agents::AgentConfig> agents);

/// Notes addresses that two agents share, and addresses with which agents cannot reach each other.
void check_networks(Mapping& in, const Scenario& scenario);

}  // namespace sim::scenario
