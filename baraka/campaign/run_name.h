#pragma once

#include <string>

#include "results/campaign/rows.h"

namespace baraka::campaign {

/// The name of a run and of its result folder: "p001-r01".
std::string campaign_run_name(const results::campaign::RunPlan& run);

/// The same for `baraka run --replications`: "replication-01".
std::string replication_name(const results::campaign::RunPlan& run);

}  // namespace baraka::campaign
