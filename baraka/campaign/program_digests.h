#pragma once

#include <set>
#include <string>

#include "sim/scenario/scenario.h"

namespace baraka::campaign {

/// Names of the controllers that drive some of a scenario's agents; without `teleop`.
std::set<std::string> controllers_of(const sim::scenario::Scenario& scenario);

/// Which files play runs with these controllers: "baraka 1f0e…, help_mote 93ab…", 64-bit hashes
/// (sim::Hash) of this program and of each controller's program and plug-in, whichever are there;
/// so that runs made with other files can be told from them. Reads the files.
std::string program_digests(const std::set<std::string>& controllers);

}  // namespace baraka::campaign
