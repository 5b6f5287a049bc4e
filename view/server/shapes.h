#pragma once

#include "sim/agents/simulation_config.h"
#include "view/server/json_text.h"

namespace view::server {

/// What a body looks like, from the file that describes it: {radius, height, cylinders, boxes,
/// wheels}. Metres and radians, body frame. null: a station has none.
Json shape_json(const sim::agents::AgentConfig& agent);

/// m: of the circle round its origin that its body is in; 0: it has none.
double body_radius(const sim::agents::AgentConfig& agent);

/// Its infrared sensors: [{x, y, z, heading, half_angle, reach}].
Json infrared_json(const sim::agents::AgentConfig& agent);

}  // namespace view::server
