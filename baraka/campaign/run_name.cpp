#include "baraka/campaign/run_name.h"

#include <fmt/format.h>

namespace baraka::campaign {

std::string campaign_run_name(const results::campaign::RunPlan& run) {
  return fmt::format("p{:03}-r{:02}", run.point, run.replication);
}

std::string replication_name(const results::campaign::RunPlan& run) {
  return fmt::format("replication-{:02}", run.replication);
}

}  // namespace baraka::campaign
