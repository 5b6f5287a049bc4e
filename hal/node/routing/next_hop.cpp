#include "hal/node/routing/next_hop.h"

#include "hal/types/path_metric.h"

namespace hal::node::routing {

std::optional<AgentId> pick_next_hop(const std::vector<Route>& routes,
                                     std::optional<AgentId> avoided, const RouteChoice& choice,
                                     RandomStream& random) {
  std::vector<Route> choices;
  for (const Route& route : routes) {
    if (route.next_hop != avoided) choices.push_back(route);
  }
  if (choices.empty()) choices = routes;
  if (choices.empty()) return std::nullopt;
  if (choices.size() == 1) return choices.front().next_hop;
  return choices[draw_route(choices, choice.metric, choice.beta, random)].next_hop;
}

}  // namespace hal::node::routing
