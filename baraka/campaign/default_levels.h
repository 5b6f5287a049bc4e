#pragma once

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace baraka::campaign {

/// What a scenario has under some keys, as a file would say it: as resolved or, of a parameter that
/// it leaves to the controller, by the controller's plug-in. "": it has no such key, as a radio
/// profile that has no power, or a grid that has become a list of poses.
/// @param keys  dotted paths, as for --set.
std::vector<std::string> values_in(const sim::scenario::Scenario& scenario,
                                   const std::vector<std::string>& keys);

}  // namespace baraka::campaign
