#pragma once

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `end:` and `expect:`, lists in the scenario's top level: when a run ends, what it is then
/// called, and what must hold at that moment. @pre the agents have been read.
void outcome_keys(Fields& io, Scenario& scenario);

}  // namespace sim::scenario
