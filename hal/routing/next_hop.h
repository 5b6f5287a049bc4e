#pragma once

#include <optional>
#include <vector>

#include "hal/routing/routing_config.h"
#include "hal/types/agent_id.h"
#include "hal/types/random.h"
#include "hal/types/route.h"

namespace hal::routing {

/// Picks the next hop of a packet: P(n) = r(n)^beta / sum over all n' of r(n')^beta, with
/// r = direct_weight if n is the destination itself and 1 / hops otherwise (Labella, Dietrich,
/// Dressler, "Hybrid simulation of Sensor and Actor Networks with BARAKA", 2009, section 6).
/// @param routes   all of one class to one destination.
/// @param avoided  not picked unless it is the only one: the node the packet just came from.
/// @return none if there are no routes. Draws from `random` only if there are two or more to
///         choose from.
std::optional<AgentId> pick_next_hop(const std::vector<Route>& routes,
                                     std::optional<AgentId> avoided, const RoutingConfig& config,
                                     RandomStream& random);

}  // namespace hal::routing
