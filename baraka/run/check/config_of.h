#pragma once

#include "hal/types/agent_id.h"
#include "sim/scenario/scenario.h"

namespace baraka::run::check {

/// @pre the agent is of the scenario.
const sim::agents::AgentConfig& config_of(const sim::scenario::Scenario& scenario, hal::AgentId id);

}  // namespace baraka::run::check
