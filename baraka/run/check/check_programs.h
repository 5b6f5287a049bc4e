#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "programs/netns/program_time.h"
#include "sim/scenario/scenario.h"

namespace baraka::run::check {

/// The files on which a run with this scenario depends, besides itself and its controllers:
/// programs inside agents, profiles of DDS, recordings. Those that do not exist are left out.
std::set<std::filesystem::path> input_files(const sim::scenario::Scenario& scenario);

/// The programs inside agents that cannot be found on this computer or whose time cannot be slowed
/// down, as "file:line:column: command: …". Files that the run itself creates ({results}) are not
/// looked for. Called before a run starts, because a program may be due only late in it.
std::vector<std::string> unusable_programs(const sim::scenario::Scenario& scenario,
                                           const programs::netns::ProgramTime& time);

}  // namespace baraka::run::check
