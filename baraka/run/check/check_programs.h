#pragma once

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace baraka::run::check {

/// The programs inside agents that cannot be found on this computer or whose time cannot be slowed,
/// "file:line:column: command: …" each. What a run is to make itself ({results}) is not looked for.
/// For before a run starts, as a program may be due only late in it.
/// @param factor  of the programs' time.
std::vector<std::string> unusable_programs(const sim::scenario::Scenario& scenario, double factor);

}  // namespace baraka::run::check
