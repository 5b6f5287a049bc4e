#pragma once

#include "sim/agents/scripted_event.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// The keys of one action of an event; an action that is impossible for its agents is a mistake.
/// @param scenario  with its agents and its radio.
void keys_of(Fields& io, agents::ScriptedAction& action, const Scenario& scenario);

}  // namespace sim::scenario
