#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/description/routing_section.h"
#include "sim/agents/simulation_config.h"

namespace sim::scenario {

/// `world:` of a scenario: `physics`, and `walls` and `boxes`, which differ in name only.
void read_world(hal::config::Mapping in, agents::SimulationConfig& config);
void write_world(hal::config::Writer& out, const agents::SimulationConfig& config);

using hal::description::read_routing;
using hal::description::write_routing;

/// What the agents' links tell their routers.
inline hal::routing::LinkCapabilities link_capabilities(const agents::SimulationConfig& config) {
  if (config.link != agents::LinkKind::kMac) return {};
  return {.tx_status = true, .rssi = radio::waves_of(config.radio) != nullptr};
}

/// `localisation:`.
agents::LocalisationConfig read_localisation(hal::config::Mapping in);
void write_localisation(hal::config::Writer& out, const agents::LocalisationConfig& config);

}  // namespace sim::scenario
