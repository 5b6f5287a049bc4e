#pragma once

#include "hal/types/agent_id.h"
#include "hal/types/route.h"
#include "hal/types/time.h"
#include "results/record/commits.h"
#include "results/record/database.h"
#include "results/record/protocols.h"
#include "results/record/schema.h"
#include "results/record/topic_writer.h"

namespace results::record {

/// Writes the table routes.
class RouteLog final : public TopicWriter {
 public:
  /// @param protocols  outlives this object.
  RouteLog(Database& database, const Protocols& protocols, Commits& commits);

  static std::vector<Table> tables();

  /// @pre the agent belongs to the run.
  void on_route_change(hal::Time at, hal::AgentId agent, const hal::RouteChange& change) override;

 private:
  Statement insert_;
  const Protocols& protocols_;
  Commits& commits_;
};

}  // namespace results::record
