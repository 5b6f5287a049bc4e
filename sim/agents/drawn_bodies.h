#pragma once

#include "hal/types/solid.h"
#include "sim/agents/simulation_config.h"

namespace sim::agents {

/// What viewers draw for an agent, in its body frame: the shapes of its file; for a robot also an
/// arrow that points forward; for a station, which has no body, a ball.
hal::DrawnBody drawn_body(const AgentConfig& agent);

/// The same for a wall, in the world frame.
hal::DrawnBody drawn_body(const physics::StaticBox& wall);

/// Whether a wall stands on the ground, not on another floor: plans show only those that do.
bool stands_on(const Ground& ground, const physics::StaticBox& wall);

}  // namespace sim::agents
