#pragma once

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `agents:` of a scenario: groups in order of declaration, each with the pattern of its names, a
/// body, where its agents stand, and a controller. Reading fills in groups and agents; addresses
/// count from 1, or from a group's `address`.
void agents_key(Fields& io, Scenario& scenario);

}  // namespace sim::scenario
