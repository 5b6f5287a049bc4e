#include "results/record/route_log.h"

#include <optional>

#include "hal/types/check.h"

namespace results::record {

RouteLog::RouteLog(Database& database, const Protocols& protocols, Commits& commits)
    : insert_(database, "INSERT INTO routes VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
      protocols_(protocols),
      commits_(commits) {}

void RouteLog::on_route_change(hal::Time at, hal::AgentId agent, const hal::RouteChange& change) {
  const hal::Route& route = change.route;
  if (change.removed) {
    insert_.run(agent.value, hal::to_ns(at), route.topic, route.destination.value,
                route.next_hop.value, std::nullopt, std::nullopt, std::nullopt, std::nullopt,
                std::nullopt);
    commits_.on_rows(at, 1);
    return;
  }
  const hal::node::routing::ProtocolKind* const protocol = protocols_.of(agent);
  BARAKA_CHECK(protocol != nullptr);
  insert_.run(agent.value, hal::to_ns(at), route.topic, route.destination.value,
              route.next_hop.value, int{route.path.hops}, route.path.delay.count(),
              route.path.min_snr_db, route.path.energy,
              protocol->weigh(protocols_.config(), route));
  commits_.on_rows(at, 1);
}

std::vector<Table> RouteLog::tables() {
  return {
      {"routes",
       "changes of agents' routing tables; only with record: {routes: all}, the default up to 100 "
       "agents",
       {{"agent", "INTEGER NOT NULL", "", "agent whose table it is"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when"},
        {"topic", "TEXT NOT NULL", "", "class of the messages"},
        {"destination", "INTEGER NOT NULL", "", "agent"},
        {"next_hop", "INTEGER NOT NULL", "", "agent"},
        {"hops", "INTEGER", "",
         "hops of the path; null, as are the columns that follow: the entry was removed"},
        {"delay_ns", "INTEGER", "ns", "expected delay of the path"},
        {"min_snr_db", "REAL", "dB", "SNR of the weakest link of the path"},
        {"energy_j", "REAL", "J", "energy to send one packet along the path"},
        {"weight", "REAL", "",
         "r(n)^beta of equation 1 of the paper: a message takes this next hop with this share of "
         "the "
         "sum over the next hops of its topic and destination; null: the protocol chooses "
         "otherwise"}}},
  };
}

}  // namespace results::record
