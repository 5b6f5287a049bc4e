#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/config/mapping.h"
#include "hal/types/geometry.h"

namespace sim::scenario {

/// Layouts that place the agents of a group: what stands under `grid`, `circle`, `line` and
/// `uniform`.
std::vector<hal::Pose2> read_grid(hal::config::Mapping in);
std::vector<hal::Pose2> read_circle_layout(hal::config::Mapping in);
std::vector<hal::Pose2> read_line_layout(hal::config::Mapping in);
/// Uniformly in a rectangle, each drawn anew until it is `spacing` away from all before it.
/// @param stream  name of the stream of random numbers, and the run's seed.
std::vector<hal::Pose2> read_uniform(hal::config::Mapping in, std::uint64_t seed,
                                     const std::string& stream);

}  // namespace sim::scenario
