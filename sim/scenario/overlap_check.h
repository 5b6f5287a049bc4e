#pragma once

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// Finds bodies that are in each other at the start: robots and motes, with one another and with
/// walls and boxes, by their exact shapes. Bodies may touch, as deep as contacts rest
/// (`surface_layer`); walls and boxes may overlap one another.
/// @return one line for each agent that overlaps something declared before it, "file:line:column:
///   agents.group: r1 overlaps r0 by …", at most kMostLines and then one that counts the rest.
std::vector<std::string> overlaps(const Scenario& scenario);

inline constexpr std::size_t kMostLines = 20;

}  // namespace sim::scenario
