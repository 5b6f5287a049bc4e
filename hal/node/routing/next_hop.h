#pragma once

#include <optional>
#include <vector>

#include "hal/node/routing/routing_config.h"
#include "hal/types/agent_id.h"
#include "hal/types/random.h"
#include "hal/types/route.h"

namespace hal::node::routing {

/// Picks the next hop of a packet with equation 1, draw_route() of hal/types/path_metric.h.
/// @param routes   all of one class to one destination.
/// @param avoided  not picked unless it is the only one: the neighbour from which the packet came.
/// @return nullopt if there are no routes. Draws from `random` only if there are two or more to
///   choose from.
std::optional<AgentId> pick_next_hop(const std::vector<Route>& routes,
                                     std::optional<AgentId> avoided, const RouteChoice& choice,
                                     RandomStream& random);

}  // namespace hal::node::routing
