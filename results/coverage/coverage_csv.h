#pragma once

#include <string>

#include "results/coverage/coverage.h"

namespace results::coverage {

/// A row for each point: where it is (z above the ground), the agent received best, its RSSI, SNR
/// and usable rate (0: none), then the RSSI of each agent, `rssi_dbm[NAME]`.
std::string coverage_csv(const Coverage& map);

}  // namespace results::coverage
