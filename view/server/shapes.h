#pragma once

#include "sim/agents/simulation_config.h"
#include "view/server/json_text.h"

namespace view::server {

/// Shape of a body, from its robot description: {radius, height, cylinders, boxes, wheels}. Metres
/// and radians, body frame. null for a station, which has no body.
Json shape_json(const sim::agents::AgentConfig& agent);

/// Radius [m] of the circle around its origin that contains the body; 0 if it has none.
double body_radius(const sim::agents::AgentConfig& agent);

/// Infrared sensors of the agent: [{x, y, z, heading, half_angle, reach}].
Json infrared_json(const sim::agents::AgentConfig& agent);

}  // namespace view::server
