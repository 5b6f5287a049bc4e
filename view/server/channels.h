#pragma once

#include "sim/agents/simulation_config.h"
#include "view/server/json_text.h"

namespace view::server {

/// The channels that an agent can read, from its robot description: [{name, kind, unit, values, x,
/// y, z, heading, first, step, low, high}]. `values`: names and units of the values of a reading,
/// if they have names. x, y, z [m] and heading [rad]: pose of the sensor in the body frame. `first`
/// and `step` [rad]: for a scan, angles of the rays relative to the heading; for a sonar, the edges
/// of its cone. low, high: measuring range in `unit`; 0, 0: not specified.
Json channels_json(const sim::agents::AgentConfig& agent);

}  // namespace view::server
