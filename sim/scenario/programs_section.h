#pragma once

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `programs:` of a group whose agents have a network.
void programs_keys(Fields& io, Group& group);

/// Notes log files that two programs would write. @param in  the top level.
void check_logs(Mapping& in, const Scenario& scenario);

}  // namespace sim::scenario
