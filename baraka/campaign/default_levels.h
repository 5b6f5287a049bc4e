#pragma once

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace baraka::campaign {

/// The values of some keys of a scenario, as a file would contain them: the resolved value or, for
/// a parameter that is not given, the default from the controller's plug-in. "": the scenario has
/// no such key, for example because the radio profile has no power, or because the resolved
/// scenario has a list of poses in place of a grid.
/// @param keys  dotted paths, as for --set.
std::vector<std::string> values_in(const sim::scenario::Scenario& scenario,
                                   const std::vector<std::string>& keys);

}  // namespace baraka::campaign
