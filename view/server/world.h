#pragma once

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"
#include "view/server/record.h"

namespace view::server {

/// What stands where, and what there is to be seen of a run: /api/runs/R/world.
/// @param record  null: nobody has run it. @param scenario  null: it cannot be read; then agents
///   have no shapes. Not both.
/// @param said  of the scenario by `baraka check`.
std::string world_json(Record* record, const sim::scenario::Scenario* scenario,
                       const std::string& name, const std::vector<std::string>& said);

}  // namespace view::server
