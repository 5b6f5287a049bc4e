#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/routing/routing_config.h"
#include "sim/agents/simulation_config.h"

namespace sim::scenario {

/// `world:` of a scenario: `physics`, and `walls` and `boxes`, which differ in name only.
void read_world(hal::config::Mapping in, agents::SimulationConfig& config);
void write_world(hal::config::Writer& out, const agents::SimulationConfig& config);

/// `routing:`. Acknowledgement and hello keys only if the link has no transmit status.
hal::routing::RoutingConfig read_routing(hal::config::Mapping in, agents::LinkKind link);
void write_routing(hal::config::Writer& out, const hal::routing::RoutingConfig& config,
                   agents::LinkKind link);

/// `localisation:`.
agents::LocalisationConfig read_localisation(hal::config::Mapping in);
void write_localisation(hal::config::Writer& out, const agents::LocalisationConfig& config);

}  // namespace sim::scenario
