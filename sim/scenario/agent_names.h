#pragma once

#include <string>
#include <vector>

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// The agent with this name; an unknown name is noted as a mistake of the key.
hal::AgentId agent_named(Mapping& in, const std::string& key, const std::string& name,
                         const Scenario& scenario);

/// The agents whose names match, by address. @param pattern  `*` and `?` match as in a shell.
std::vector<hal::AgentId> agents_like(const std::string& pattern, const Scenario& scenario);

/// The agent with this name or, if it contains `*` or `?`, the agents that match it. If there is
/// none, this is noted as a mistake of the key.
std::vector<hal::AgentId> agents_meant(Mapping& in, const std::string& key,
                                       const std::string& name_or_pattern,
                                       const Scenario& scenario);

/// The declaration of an agent. @pre the agent exists.
const agents::AgentConfig& declared(hal::AgentId id, const Scenario& scenario);

/// Whether an agent has a battery.
bool has_battery(const agents::AgentConfig& agent);

}  // namespace sim::scenario
