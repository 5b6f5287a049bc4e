#pragma once

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace gateway {

/// The programs inside agents that cannot be found on this computer, "file:line:column: command: …"
/// each. What a run is to make itself ({results}) is not looked for.
std::vector<std::string> missing_programs(const sim::scenario::Scenario& scenario);

/// Before a run starts, as a program may be due only late in it.
/// @throws hal::config::ConfigErrors  one is missing.
void require_programs(const sim::scenario::Scenario& scenario);

}  // namespace gateway
