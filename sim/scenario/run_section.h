#pragma once

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// The keys at a scenario's top level that are single values.
void run_keys(Fields& io, Scenario& scenario);
/// `record`. @pre the agents have been read, because the defaults depend on their number.
void record_keys(Fields& io, Scenario& scenario);

}  // namespace sim::scenario
