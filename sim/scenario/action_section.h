#pragma once

#include "sim/agents/scripted_event.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// Reads one thing that an event does; what cannot be done to those agents is a mistake.
/// @param scenario  with its agents and its radio.
agents::ScriptedAction read_action(Mapping in, const Scenario& scenario);

/// Into an item that is open.
void write_action(Writer& out, const agents::ScriptedAction& action);

}  // namespace sim::scenario
