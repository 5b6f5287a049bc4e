#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>

#include "hal/routing/protocol_event.h"
#include "hal/types/agent_id.h"
#include "sim/record/database.h"

namespace sim::record {

/// The table routing_events: what the routing protocols of the agents did, by agent and event.
class RoutingCounts {
 public:
  explicit RoutingCounts(Database& database);

  void on_event(hal::AgentId agent, hal::routing::ProtocolEvent event) {
    ++counts_[agent][static_cast<std::size_t>(event)];
    changed_ = true;
  }

  /// Writes all rows anew, if there is anything new.
  void write();

 private:
  Statement put_;
  std::map<hal::AgentId, std::array<std::uint64_t, hal::routing::kProtocolEvents>> counts_;
  bool changed_ = false;
};

}  // namespace sim::record
