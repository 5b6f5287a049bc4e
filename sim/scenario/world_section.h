#pragma once

#include "hal/files/description/routing_section.h"
#include "sim/agents/simulation_config.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {

/// `world:` of a scenario: `physics`, and `walls` and `boxes`, which differ in name only.
void world_keys(Fields& io, agents::SimulationConfig& config);

using hal::files::description::read_routing;
using hal::files::description::write_routing;

/// What the agents' links tell their routers.
inline hal::node::routing::LinkCapabilities link_capabilities(
    const agents::SimulationConfig& config) {
  if (config.link != agents::LinkKind::kMac) return {};
  return {.tx_status = true, .rssi = radio::waves_of(config.radio) != nullptr};
}

/// `localisation:`.
void keys_of(Fields& io, agents::LocalisationConfig& config);

}  // namespace sim::scenario
