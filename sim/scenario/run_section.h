#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// The keys of a scenario's top level that are single values, and `record`.
void read_run(hal::config::Mapping& in, Scenario& scenario);
/// @pre the agents are read: the defaults depend on their number.
void read_record(hal::config::Mapping in, Scenario& scenario);
void write_run(hal::config::Writer& out, const Scenario& scenario);

}  // namespace sim::scenario
