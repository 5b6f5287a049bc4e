#pragma once

#include <string>

#include "sim/agents/simulation_config.h"
#include "view/server/json_text.h"
#include "view/server/record.h"
#include "view/server/tile.h"

namespace view::server {

/// The movables by their numbers, with their poses at the start: [{name, form, length_x, length_y,
/// length_z, x, y, z, yaw}]; m and rad, of their centres, world frame.
Json movables_json(const sim::agents::SimulationConfig& config);

/// The same from a record, if the scenario cannot be read; without poses.
Json movables_json(Record& record);

/// Poses of movables: each begins with its last before the span.
std::string movables_tile(Record& record, const Span& span);

}  // namespace view::server
