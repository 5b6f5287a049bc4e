#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/config/mapping.h"
#include "hal/types/geometry.h"

namespace sim::scenario {

/// Where the agents of a group stand: `poses`, or one of the layouts (layouts.h).
/// @param seed  of the run.   @param group  its name.
/// @param places  gets "file:line:column" of each pose, or of the layout, for error messages.
std::vector<hal::Pose2> read_poses(hal::config::Mapping& in, std::uint64_t seed,
                                   const std::string& group, std::vector<std::string>& places);

/// `name`: for one agent its name; for several a pattern with one {} for their numbers from 0.
/// Absent: the group's name and {}.
std::vector<std::string> read_names(hal::config::Mapping& in, const std::string& group,
                                    std::size_t count);

}  // namespace sim::scenario
