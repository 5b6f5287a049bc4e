#pragma once

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// Reads `events:`. @param scenario  with its agents and its radio.
void read_events(Mapping& in, Scenario& scenario);

/// Nothing if there are none.
void write_events(Writer& out, const Scenario& scenario);

}  // namespace sim::scenario
