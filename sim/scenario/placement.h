#pragma once

#include <string>
#include <vector>

#include "hal/config/mapping.h"
#include "hal/types/geometry.h"

namespace sim::scenario {

/// Where the agents of a group stand: `grid` or `poses`, one of which must be there.
/// @param places  gets "file:line:column" of each pose, or of the grid, for error messages.
std::vector<hal::Pose2> read_poses(hal::config::Mapping& in, std::vector<std::string>& places);

/// `name`: for one agent its name; for several a pattern with one {} for their numbers from 0.
/// Absent: the group's name and {}.
std::vector<std::string> read_names(hal::config::Mapping& in, const std::string& group,
                                    std::size_t count);

}  // namespace sim::scenario
