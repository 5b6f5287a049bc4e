#pragma once

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `end:` and `expect:`, lists at the scenario's top level: when a run ends, the name of its
/// result, and what must hold at that time. @pre the agents have been read.
void outcome_keys(Fields& io, Scenario& scenario);

}  // namespace sim::scenario
