#pragma once

#include <string>
#include <vector>

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// The agent that is called so; an unknown name is noted as a mistake of the key.
hal::AgentId agent_named(Mapping& in, const std::string& key, const std::string& name,
                         const Scenario& scenario);

/// Those whose names match, by address. @param pattern  `*` and `?` match as in a shell.
std::vector<hal::AgentId> agents_like(const std::string& pattern, const Scenario& scenario);

/// The one of that name or, if it has `*` or `?`, those that match: at least one, or it is noted as
/// a mistake of the key.
std::vector<hal::AgentId> agents_meant(Mapping& in, const std::string& key,
                                       const std::string& name_or_pattern,
                                       const Scenario& scenario);

/// @pre there is one.
const agents::AgentConfig& declared(hal::AgentId id, const Scenario& scenario);

/// Whether it has at least one battery.
bool has_battery(const agents::AgentConfig& agent);

}  // namespace sim::scenario
