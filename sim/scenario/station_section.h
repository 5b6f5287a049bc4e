#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "sim/agents/simulation_config.h"

namespace sim::scenario {

/// `station:` of a group of agents: no body, and a `path` or none.
agents::Station read_station_body(hal::config::Mapping in);
void write_station_body(hal::config::Writer& out, const agents::Station& station);

}  // namespace sim::scenario
