#include "sim/scenario/static_routes_check.h"

#include <vector>

#include "hal/files/description/static_routes.h"

namespace sim::scenario {
namespace {

using hal::files::description::NamedAgent;
using hal::node::routing::Algorithm;

/// A group cannot have routes of its own.
void refuse_groups(Mapping& in, const Scenario& scenario) {
  Mapping agents = in.within("agents");
  for (const agents::AgentConfig& agent : scenario.simulation.agents) {
    if (agent.routing != Algorithm::kStatic) continue;
    for (const Group& group : scenario.groups) {
      if (group.agents.empty() || group.agents.front() != agent.id) continue;
      agents.within(group.name)
          .mistake(
              "routing",
              "static needs the routes of the scenario: 'routing: {algorithm: static, routes: …}'");
    }
  }
}

}  // namespace

void find_static_routes(Mapping& in, Scenario& scenario) {
  agents::SimulationConfig& config = scenario.simulation;
  if (config.routing.algorithm != Algorithm::kStatic) return refuse_groups(in, scenario);
  std::vector<NamedAgent> names;
  names.reserve(config.agents.size());
  for (const agents::AgentConfig& agent : config.agents) names.push_back({agent.name, agent.id});
  const auto routes = hal::files::description::static_routes(in.within("routing"),
                                                             config.routing.statics.rows, names);
  for (std::size_t i = 0; i < routes.size(); ++i) config.agents[i].static_routes = routes[i];
}

}  // namespace sim::scenario
