#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>

#include "hal/node/routing/protocol_event.h"
#include "hal/types/agent_id.h"
#include "results/record/commits.h"
#include "results/record/database.h"
#include "results/record/schema.h"
#include "results/record/topic_writer.h"

namespace results::record {

/// Writes the tables discoveries and routing_events: what the routing protocols of the agents did,
/// by agent and event.
class RoutingCounts final : public TopicWriter {
 public:
  RoutingCounts(Database& database, Commits& commits);

  static std::vector<Table> tables();

  void on_discovery(hal::Time at, hal::AgentId agent,
                    const sim::agents::Discovery& discovery) override;
  void on_protocol_event(hal::AgentId agent, hal::node::routing::ProtocolEvent event) override {
    ++counts_[agent][static_cast<std::size_t>(event)];
    changed_ = true;
  }

  /// Rewrites all rows, if a count changed.
  void write(hal::Time now) override;

 private:
  Statement insert_discovery_, put_;
  std::map<hal::AgentId, std::array<std::uint64_t, hal::node::routing::kProtocolEvents>> counts_;
  bool changed_ = false;
  Commits& commits_;
};

}  // namespace results::record
