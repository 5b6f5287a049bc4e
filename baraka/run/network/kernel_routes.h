#pragma once

#include <vector>

#include "programs/netns/namespaces.h"
#include "sim/agents/simulation_config.h"

namespace baraka::run::network {

/// The routes of an agent as its kernel has them: one to each address of an agent, of IPv6 only if
/// both it and the next hop have IPv6.
/// @param agent  has a network. @param all  agents of the run.
std::vector<programs::netns::KernelRoute> kernel_routes(
    const sim::agents::AgentConfig& agent, const std::vector<sim::agents::AgentConfig>& all);

}  // namespace baraka::run::network
