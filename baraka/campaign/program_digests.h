#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "sim/scenario/scenario.h"

namespace baraka::campaign {

/// Names of the controllers in a scenario, without `teleop`.
std::set<std::string> controllers_of(const sim::scenario::Scenario& scenario);

/// Identifies the files that runs use, to recognise runs made with other files: "baraka 1f0e…,
/// help_mote 93ab…", with 64-bit hashes (sim::Hash) of this program and of each controller's
/// program and plug-in, as far as they exist, and of other files by name. Reads the files.
std::string program_digests(const std::set<std::string>& controllers,
                            const std::set<std::filesystem::path>& files);

}  // namespace baraka::campaign
