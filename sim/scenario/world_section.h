#pragma once

#include "hal/node/routing/ports.h"
#include "sim/agents/simulation_config.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/world_map.h"

namespace sim::scenario {

/// `world:` of a scenario: `physics`; `walls` and `boxes`, which differ only in their names; `map`.
void world_keys(Fields& io, agents::SimulationConfig& config, std::vector<WorldMap>& maps);

/// What a wall is like, or all walls of a map: friction, material, radio's loss.
/// @param materials  those of the scenario.
void surface_keys(Fields& io, std::span<const Material> materials, physics::StaticBox& box);

/// What the agents' links report to their routers.
inline hal::node::routing::LinkCapabilities link_capabilities(
    const agents::SimulationConfig& config) {
  if (config.link != agents::LinkKind::kMac) return {};
  return {.tx_status = true, .rssi = radio::waves_of(config.radio) != nullptr};
}

/// `localisation:`.
void keys_of(Fields& io, agents::LocalisationConfig& config);

}  // namespace sim::scenario
