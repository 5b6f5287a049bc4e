#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/types/geometry.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// True position of an agent at the end of the run [m, world frame].
using TruePosition = std::function<hal::Vec2(hal::AgentId)>;

/// The expectations that do not hold, one line each: "place: expect: what was seen and what was
/// expected". Empty: all hold.
std::vector<std::string> unmet_expectations(const Scenario& scenario, std::string_view result,
                                            const TruePosition& position);

}  // namespace sim::scenario
