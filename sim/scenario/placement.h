#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/types/geometry.h"
#include "sim/scenario/layouts.h"

namespace sim::scenario {

/// `poses`, or one of the layouts.
/// @param places  receives "file:line:column" of each pose that is read.
void placement_keys(Fields& io, Placement& placement, std::vector<std::string>& places);

/// The poses of the agents of a group; notes mistakes of a layout.
/// @param seed  of the run.   @param group  its name.
/// @param places  receives the place of the layout for each agent that it places.
std::vector<hal::Pose2> poses_of(Mapping& in, const Placement& placement, std::uint64_t seed,
                                 const std::string& group, std::vector<std::string>& places);

/// `name`: the name of a single agent; for several agents a pattern in which {} stands for their
/// numbers from 0.
void name_key(Fields& io, std::string& pattern);

/// The names of `count` agents. A pattern that does not give valid and distinct names is a mistake.
std::vector<std::string> names_of(Mapping& in, const std::string& pattern, std::size_t count);

}  // namespace sim::scenario
