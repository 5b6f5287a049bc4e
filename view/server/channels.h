#pragma once

#include "sim/agents/simulation_config.h"
#include "view/server/json_text.h"

namespace view::server {

/// What an agent can read, from the file that describes it:
/// [{name, kind, unit, values, x, y, z, heading, first, step, low, high}]. `values`: names of the
/// values of a reading with their units, if they have names. x, y, z [m] and heading [rad] of the
/// sensor, body frame; `first` and `step` [rad]: of the rays of a scan, from its heading on; of a
/// sonar the edges of its cone. low, high: what it can measure, in `unit`; 0, 0: not said.
Json channels_json(const sim::agents::AgentConfig& agent);

}  // namespace view::server
