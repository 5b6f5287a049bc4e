#pragma once

#include <vector>

#include "sim/scenario/fields.h"
#include "sim/scenario/plot_request.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `report:` of a scenario or of a campaign: the plots of its report. Does not affect runs.
void report_keys(Fields& io, std::vector<PlotRequest>& requests);

/// `compare:`: the published results that the report shows beside those of the runs.
void compare_key(Fields& io, Published& published);

}  // namespace sim::scenario
