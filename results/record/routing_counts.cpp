#include "results/record/routing_counts.h"

namespace results::record {

RoutingCounts::RoutingCounts(Database& database)
    : put_(database, "REPLACE INTO routing_events VALUES (?, ?, ?)") {}

void RoutingCounts::write() {
  if (!changed_) return;
  for (const auto& [agent, counts] : counts_) {
    for (std::size_t event = 0; event < counts.size(); ++event) {
      if (counts[event] == 0) continue;
      put_.run(agent.value,
               hal::node::routing::name(static_cast<hal::node::routing::ProtocolEvent>(event)),
               counts[event]);
    }
  }
  changed_ = false;
}

}  // namespace results::record
