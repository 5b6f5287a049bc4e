#pragma once

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `events:`; not written if empty. @param scenario  with its agents and its radio.
void event_keys(Fields& io, Scenario& scenario);

}  // namespace sim::scenario
