#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// The scenario as one YAML file without includes, with every key written out, as stored with the
/// results. load_scenario() reads it back to equal values; only the places differ.
std::string resolved_yaml(const Scenario& scenario);

/// The same as pairs: dotted path (list items by number) and value as written there.
std::vector<std::pair<std::string, std::string>> resolved_values(const Scenario& scenario);

}  // namespace sim::scenario
