#pragma once

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `observables` of the mapping `record`. @pre the agents have been read.
void observables_keys(Fields& io, Scenario& scenario);

}  // namespace sim::scenario
