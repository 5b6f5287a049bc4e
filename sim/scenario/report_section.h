#pragma once

#include <vector>

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "sim/report/plot_request.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `report:` of a scenario or of a campaign: what its report shows. Changes nothing about a run.
std::vector<report::PlotRequest> read_report(hal::config::Mapping& in);
void write_report(hal::config::Writer& out, const std::vector<report::PlotRequest>& requests);

/// `compare:`: whose published figures the report shows beside the runs'.
Published read_compare(hal::config::Mapping& in);
void write_compare(hal::config::Writer& out, Published published);

}  // namespace sim::scenario
