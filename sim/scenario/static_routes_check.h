#pragma once

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// Gives each agent its routes, if the scenario has `algorithm: static`, and notes what is wrong
/// with them: see hal::files::description::static_routes.
void find_static_routes(Mapping& in, Scenario& scenario);

}  // namespace sim::scenario
