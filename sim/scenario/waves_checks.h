#pragma once

#include "hal/files/config/mapping.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// Notes antennas on the ground, whose two rays cancel each other, and warns of `obstacles` if
/// nothing can be an obstacle. @param in  the top level of the file.
void check_waves(hal::files::config::Mapping& in, const Scenario& scenario);

}  // namespace sim::scenario
