#pragma once

#include "sim/agents/simulation_config.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {

/// `station:` of a group of agents: no body, and an optional `path`.
void station_keys(Fields& io, agents::Station& station);

}  // namespace sim::scenario
