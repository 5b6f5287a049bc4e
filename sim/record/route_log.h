#pragma once

#include <vector>

#include "hal/routing/routing_config.h"
#include "hal/types/agent_id.h"
#include "hal/types/route.h"
#include "hal/types/time.h"
#include "sim/agents/simulation_config.h"
#include "sim/record/database.h"

namespace sim::record {

/// The table routes.
class RouteLog {
 public:
  RouteLog(Database& database, const agents::SimulationConfig& config);

  void on_route_change(hal::Time at, hal::AgentId agent, const hal::RouteChange& change);

 private:
  Statement insert_;
  hal::routing::RoutingConfig routing_;
  std::vector<hal::routing::Algorithm> algorithms_;  ///< By address.
};

}  // namespace sim::record
