#pragma once

#include <string>
#include <vector>

#include "results/fleet/fleet_answer.h"
#include "results/fleet/fleet_file.h"

namespace results::fleet {

/// The means behind the page's tables, for other programs: a row for each case and topic group,
/// with times in seconds, shares from 0 to 1, and empty cells for what no run has. `holds` is 1 if
/// every need holds in the case.
std::string fleet_csv(const FleetFile& fleet, const std::vector<FleetLine>& lines);

}  // namespace results::fleet
