#pragma once

#include <string>
#include <vector>

#include "results/fleet/fleet_answer.h"
#include "results/fleet/fleet_file.h"

namespace results::fleet {

/// The answer as one self-contained page of HTML: sentences, the summary, the best profile's XML,
/// and for each line its tables and curves against the number of robots.
std::string fleet_page(const FleetFile& fleet, const std::vector<FleetLine>& lines);

}  // namespace results::fleet
