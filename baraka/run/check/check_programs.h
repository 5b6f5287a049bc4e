#pragma once

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace baraka::run::check {

/// The programs inside agents that cannot be found on this computer or whose time cannot be slowed
/// down, as "file:line:column: command: …". Files that the run itself creates ({results}) are not
/// looked for. Called before a run starts, because a program may be due only late in it.
/// @param factor  speed of the programs' time relative to wall time.
std::vector<std::string> unusable_programs(const sim::scenario::Scenario& scenario, double factor);

}  // namespace baraka::run::check
