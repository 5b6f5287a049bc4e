#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `end:` and `expect:`, lists in the scenario's top level: when a run ends, what it is then
/// called, and what must hold at that moment. @pre the agents have been read.
void read_ends(hal::config::Mapping& in, Scenario& scenario);
void read_expectations(hal::config::Mapping& in, Scenario& scenario);
void write_ends(hal::config::Writer& out, const Scenario& scenario);
void write_expectations(hal::config::Writer& out, const Scenario& scenario);

}  // namespace sim::scenario
