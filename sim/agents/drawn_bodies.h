#pragma once

#include "hal/types/solid.h"
#include "sim/agents/simulation_config.h"

namespace sim::agents {

/// What viewers draw of an agent, in the frame of its body: the shapes of its file; an arrow of a
/// robot, which shows where forward is; a ball of a station, which has no body.
hal::DrawnBody drawn_body(const AgentConfig& agent);

/// The same of a wall, in the world.
hal::DrawnBody drawn_body(const physics::StaticBox& wall);

}  // namespace sim::agents
