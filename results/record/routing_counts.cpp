#include "results/record/routing_counts.h"

namespace results::record {

RoutingCounts::RoutingCounts(Database& database, Commits& commits)
    : insert_discovery_(database, "INSERT INTO discoveries VALUES (?, ?, ?, ?, ?, ?)"),
      put_(database, "REPLACE INTO routing_events VALUES (?, ?, ?)"),
      commits_(commits) {}

void RoutingCounts::on_discovery(hal::Time at, hal::AgentId agent,
                                 const sim::agents::Discovery& discovery) {
  insert_discovery_.run(agent.value, discovery.topic, discovery.destination.value, hal::to_ns(at),
                        discovery.took.count(), discovery.found);
  commits_.on_rows(at, 1);
}

void RoutingCounts::write(hal::Time) {
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

std::vector<Table> RoutingCounts::tables() {
  return {
      {"discoveries",
       "route discoveries",
       {{"agent", "INTEGER NOT NULL", "", "agent that searched"},
        {"topic", "TEXT NOT NULL", "", "class of the messages"},
        {"destination", "INTEGER NOT NULL", "", "agent"},
        {"ended_ns", "INTEGER NOT NULL", "ns", "when"},
        {"took_ns", "INTEGER NOT NULL", "ns", "since the first message waited for it"},
        {"found", "INTEGER NOT NULL", "", "0: given up"}}},
      {"routing_events",
       "number of events of the routing protocols",
       {{"agent", "INTEGER NOT NULL", "", "agent whose router it is"},
        {"event", "TEXT NOT NULL", "", "'rreq sent', 'forward ant relayed', ..., by protocol"},
        {"count", "INTEGER NOT NULL", "", "number of events"}},
       "agent, event"},
  };
}

}  // namespace results::record
