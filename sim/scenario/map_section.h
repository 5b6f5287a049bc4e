#pragma once

#include <vector>

#include "sim/agents/simulation_config.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/world_map.h"

namespace sim::scenario {

struct Scenario;

inline constexpr std::size_t kMostMapWalls = 100'000;

/// `world.map`: a map or a list of maps. Their occupied cells are added to the walls.
void map_keys(Fields& io, std::vector<WorldMap>& maps, agents::SimulationConfig& config);

/// Removes the walls that came from maps: a file has the maps instead.
void drop_map_walls(Scenario& scenario);

/// The walls of a map. Each is 1 nm larger than its cells on all four sides, so that nothing passes
/// between two that touch.
/// @param[in,out] map  `image` and `walls` are set.
/// @throws hal::files::config::ConfigErrors  mistakes in the YAML file. @throws std::runtime_error
/// the image cannot be read, or there are more than kMostMapWalls.
std::vector<physics::StaticBox> walls_of(WorldMap& map, const Ground& ground);

}  // namespace sim::scenario
