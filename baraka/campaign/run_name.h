#pragma once

#include <string>

#include "results/campaign/rows.h"

namespace baraka::campaign {

/// "p001-r01": of a run and of the folder of its result.
std::string campaign_run_name(const results::campaign::RunPlan& run);

/// "replication-01": the same for `baraka run --replications`.
std::string replication_name(const results::campaign::RunPlan& run);

}  // namespace baraka::campaign
