#pragma once

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `movables:` of `world:`.
void movables_key(Fields& io, Scenario& scenario);

}  // namespace sim::scenario
