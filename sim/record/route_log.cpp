#include "sim/record/route_log.h"

#include <optional>

#include "hal/types/math.h"
#include "hal/types/path_metric.h"

namespace sim::record {

using hal::routing::Algorithm;

RouteLog::RouteLog(Database& database, const agents::SimulationConfig& config)
    : insert_(database, "INSERT INTO routes VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
      routing_(config.routing) {
  for (const agents::AgentConfig& agent : config.agents) {
    if (agent.id.value >= algorithms_.size()) algorithms_.resize(agent.id.value + 1u);
    algorithms_[agent.id.value] = agent.routing.value_or(config.routing.algorithm);
  }
}

void RouteLog::on_route_change(hal::Time at, hal::AgentId agent, const hal::RouteChange& change) {
  const hal::Route& route = change.route;
  if (change.removed) {
    insert_.run(agent.value, hal::to_ns(at), route.topic, route.destination.value,
                route.next_hop.value, std::nullopt, std::nullopt, std::nullopt, std::nullopt,
                std::nullopt);
    return;
  }
  std::optional<double> weight;
  const Algorithm algorithm = algorithms_[agent.value];
  if (algorithm == Algorithm::kAodv) weight = 1;  // it has one next hop
  if (algorithm == Algorithm::kAnts) {
    const hal::routing::RouteChoice& choice = routing_.choice_of(route.topic);
    const bool is_destination = route.next_hop == route.destination;
    weight =
        hal::math::pow(hal::path_value(choice.metric, route.path, is_destination), choice.beta);
  }
  insert_.run(agent.value, hal::to_ns(at), route.topic, route.destination.value,
              route.next_hop.value, int{route.path.hops}, route.path.delay.count(),
              route.path.min_snr_db, route.path.energy, weight);
}

}  // namespace sim::record
