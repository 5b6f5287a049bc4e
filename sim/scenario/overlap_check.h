#pragma once

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// Finds bodies that overlap at the start: robots, motes and movables with one another and with
/// walls and boxes, by their exact shapes, a sphere by the cylinder around it. Bodies may overlap
/// as deep as resting contacts do
/// (`surface_layer`); walls and boxes may overlap one another.
/// @return one line for each agent or movable that overlaps something declared before it,
/// "file:line:column:
///   agents.group: r1 overlaps r0 by …": at most kMostLines, then one with the number of the rest.
std::vector<std::string> overlaps(const Scenario& scenario);

inline constexpr std::size_t kMostLines = 20;

}  // namespace sim::scenario
