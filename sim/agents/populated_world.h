#pragma once

#include <memory>

#include "sim/agents/simulation_config.h"
#include "sim/physics/world.h"

namespace sim::agents {

/// A world with all walls and then every body, each in the order of the configuration, which is
/// part of the run's identity. @throws std::invalid_argument  as physics::World.
std::unique_ptr<physics::World> populated_world(const SimulationConfig& config);

}  // namespace sim::agents
