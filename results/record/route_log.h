#pragma once

#include "hal/types/agent_id.h"
#include "hal/types/route.h"
#include "hal/types/time.h"
#include "results/record/database.h"
#include "results/record/protocols.h"

namespace results::record {

/// The table routes.
class RouteLog {
 public:
  /// @param protocols  outlives it.
  RouteLog(Database& database, const Protocols& protocols);

  /// @pre the agent is one of the run's.
  void on_route_change(hal::Time at, hal::AgentId agent, const hal::RouteChange& change);

 private:
  Statement insert_;
  const Protocols& protocols_;
};

}  // namespace results::record
