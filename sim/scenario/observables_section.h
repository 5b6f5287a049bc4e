#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `observables` of the mapping `record`. @pre the agents are read.
void read_observables(hal::config::Mapping& record, Scenario& scenario);
void write_observables(hal::config::Writer& out, const Scenario& scenario);

}  // namespace sim::scenario
