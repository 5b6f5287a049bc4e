#pragma once

#include <vector>

#include "sim/scenario/fields.h"
#include "sim/scenario/plot_request.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `report:` of a scenario or of a campaign: what its report shows. Changes nothing about a run.
void report_keys(Fields& io, std::vector<PlotRequest>& requests);

/// `compare:`: whose published figures the report shows beside the runs'.
void compare_key(Fields& io, Published& published);

}  // namespace sim::scenario
