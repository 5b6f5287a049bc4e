#pragma once

#include <memory>

#include "sim/agents/simulation_config.h"
#include "sim/physics/world.h"

namespace sim::agents {

/// Makes a world with all walls, then all agents' bodies and then all movables, each in the order
/// of the configuration; results depend on that order. @throws std::invalid_argument  as
/// physics::World.
std::unique_ptr<physics::World> populated_world(const SimulationConfig& config);

}  // namespace sim::agents
