#include "results/record/route_log.h"

#include <optional>

#include "hal/types/check.h"

namespace results::record {

RouteLog::RouteLog(Database& database, const Protocols& protocols)
    : insert_(database, "INSERT INTO routes VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
      protocols_(protocols) {}

void RouteLog::on_route_change(hal::Time at, hal::AgentId agent, const hal::RouteChange& change) {
  const hal::Route& route = change.route;
  if (change.removed) {
    insert_.run(agent.value, hal::to_ns(at), route.topic, route.destination.value,
                route.next_hop.value, std::nullopt, std::nullopt, std::nullopt, std::nullopt,
                std::nullopt);
    return;
  }
  const hal::node::routing::ProtocolKind* const protocol = protocols_.of(agent);
  BARAKA_CHECK(protocol != nullptr);
  insert_.run(agent.value, hal::to_ns(at), route.topic, route.destination.value,
              route.next_hop.value, int{route.path.hops}, route.path.delay.count(),
              route.path.min_snr_db, route.path.energy,
              protocol->weigh(protocols_.config(), route));
}

}  // namespace results::record
