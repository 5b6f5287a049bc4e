#pragma once

#include <span>
#include <vector>

#include "hal/files/config/mapping.h"
#include "hal/files/description/route_names.h"
#include "hal/node/routing/static_config.h"

namespace hal::files::description {

/// The routes that the rows of a file give to each agent.
///
/// Mistakes are noted: no rows at all, and in the rows unknown names, routes of an agent to or via
/// itself, agents that are on a path twice, and loops: routes to a destination that lead back to
/// where they were. A route that leads to an agent without one to the same destination is a
/// warning.
/// @param routing  the mapping `routing`, from which the rows were read.
/// @param agents  with different names and addresses.
/// @return by index in `agents`, for each in the order of the destinations in `agents`; empty after
///   a mistake.
std::vector<std::vector<node::routing::StaticRoute>> static_routes(
    config::Mapping routing, const std::vector<node::routing::StaticRow>& rows,
    std::span<const NamedAgent> agents);

}  // namespace hal::files::description
