#pragma once

#include <string>

#include "sim/campaign/rows.h"

namespace gateway {

/// "p001-r01": of a run and of the folder of its result.
std::string campaign_run_name(const sim::campaign::RunPlan& run);

/// "replication-01": the same for `baraka run --replications`.
std::string replication_name(const sim::campaign::RunPlan& run);

}  // namespace gateway
