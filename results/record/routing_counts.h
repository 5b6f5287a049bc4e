#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>

#include "hal/node/routing/protocol_event.h"
#include "hal/types/agent_id.h"
#include "results/record/database.h"

namespace results::record {

/// The table routing_events: what the routing protocols of the agents did, by agent and event.
class RoutingCounts {
 public:
  explicit RoutingCounts(Database& database);

  void on_event(hal::AgentId agent, hal::node::routing::ProtocolEvent event) {
    ++counts_[agent][static_cast<std::size_t>(event)];
    changed_ = true;
  }

  /// Writes all rows anew, if there is anything new.
  void write();

 private:
  Statement put_;
  std::map<hal::AgentId, std::array<std::uint64_t, hal::node::routing::kProtocolEvents>> counts_;
  bool changed_ = false;
};

}  // namespace results::record
