#pragma once

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"
#include "view/server/record.h"

namespace view::server {

/// The static part of a run, and a list of what can be requested: the answer to /api/runs/R/world.
/// At least one of record and scenario must be given.
/// @param record  null: the scenario has not been run.
/// @param scenario  null: it cannot be read; then agents have no shapes.
/// @param said  messages of `baraka check` about the scenario.
std::string world_json(Record* record, const sim::scenario::Scenario* scenario,
                       const std::string& name, const std::vector<std::string>& said);

}  // namespace view::server
