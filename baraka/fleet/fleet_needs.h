#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/fleet/fleet_file.h"
#include "results/fleet/fleet_points.h"

namespace baraka::fleet {

/// Needs that are about no topic and reader of the case with the most robots of a radio, site and
/// profile: "file:line:column: need: …" with the topics that there are, each for the first such
/// case. Nothing is said of
/// scenarios with `programs` or controllers inside, whose topics are not known before they run.
/// @param scenario  its file.
/// @throws hal::files::config::ConfigErrors  the scenario has mistakes.
std::vector<std::string> unmatched_needs(const results::fleet::FleetFile& fleet,
                                         const results::fleet::FleetPlan& plan,
                                         const std::filesystem::path& scenario);

}  // namespace baraka::fleet
