#pragma once

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `agents:` of a scenario: groups in order of declaration, each with a pattern for names, a body,
/// a placement and a controller. Reading fills in groups and agents; addresses are counted from 1,
/// or from a group's `address`.
void agents_key(Fields& io, Scenario& scenario);

}  // namespace sim::scenario
