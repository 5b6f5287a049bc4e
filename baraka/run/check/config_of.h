#pragma once

#include "hal/types/agent_id.h"
#include "sim/scenario/scenario.h"

namespace baraka::run::check {

/// The configuration of an agent. @pre The scenario has the agent.
const sim::agents::AgentConfig& config_of(const sim::scenario::Scenario& scenario, hal::AgentId id);

}  // namespace baraka::run::check
