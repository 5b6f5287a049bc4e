#pragma once

#include <string>
#include <vector>

#include "programs/netns/program_time.h"
#include "sim/scenario/scenario.h"

namespace baraka::run::check {

/// The programs inside agents that cannot be found on this computer or whose time cannot be slowed
/// down, as "file:line:column: command: …". Files that the run itself creates ({results}) are not
/// looked for. Called before a run starts, because a program may be due only late in it.
std::vector<std::string> unusable_programs(const sim::scenario::Scenario& scenario,
                                           const programs::netns::ProgramTime& time);

}  // namespace baraka::run::check
