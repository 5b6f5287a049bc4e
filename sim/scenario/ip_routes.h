#pragma once

#include <vector>

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `routes:` of a group's network.
void ip_routes_key(Fields& io, std::vector<hal::node::routing::StaticRow>& rows);

/// Gives the networks of all agents their routes, and notes what is wrong with the rows: unknown
/// names, agents without a network, routes of an agent to or via itself, next hops that the agent
/// cannot reach directly (on another channel, or on another network without a direct route), and
/// loops. A next hop without a route to the same destination is a warning.
void find_ip_routes(Mapping& in, Scenario& scenario);

}  // namespace sim::scenario
