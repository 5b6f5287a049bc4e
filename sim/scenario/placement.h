#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/types/geometry.h"
#include "sim/scenario/layouts.h"

namespace sim::scenario {

/// `poses`, or one of the layouts.
/// @param places  gets "file:line:column" of each pose that is read.
void placement_keys(Fields& io, Placement& placement, std::vector<std::string>& places);

/// Where the agents of a group stand; mistakes of a layout are noted.
/// @param seed  of the run.   @param group  its name.
/// @param places  gets that of the layout for each agent that it places.
std::vector<hal::Pose2> poses_of(Mapping& in, const Placement& placement, std::uint64_t seed,
                                 const std::string& group, std::vector<std::string>& places);

/// `name`: for one agent its name; for several a pattern with one {} for their numbers from 0.
void name_key(Fields& io, std::string& pattern);

/// The names of so many agents. A pattern that gives no names is a mistake.
std::vector<std::string> names_of(Mapping& in, const std::string& pattern, std::size_t count);

}  // namespace sim::scenario
