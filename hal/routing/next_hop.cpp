#include "hal/routing/next_hop.h"

#include <algorithm>

#include "hal/types/math.h"

namespace hal::routing {
namespace {

double quality(const Route& route, const RoutingConfig& config) {
  if (route.next_hop == route.destination) return config.direct_weight;
  return 1.0 / std::max<int>(1, route.path.hops);
}

/// Unnormalised probabilities. Relative to the best, so that no power overflows.
std::vector<double> weights(const std::vector<Route>& routes, const RoutingConfig& config) {
  std::vector<double> result;
  result.reserve(routes.size());
  for (const Route& route : routes) result.push_back(quality(route, config));
  const double best = *std::max_element(result.begin(), result.end());
  for (double& weight : result) weight = math::pow(weight / best, config.beta);
  return result;
}

}  // namespace

std::optional<AgentId> pick_next_hop(const std::vector<Route>& routes,
                                     std::optional<AgentId> avoided, const RoutingConfig& config,
                                     RandomStream& random) {
  std::vector<Route> choices;
  for (const Route& route : routes) {
    if (route.next_hop != avoided) choices.push_back(route);
  }
  if (choices.empty()) choices = routes;
  if (choices.empty()) return std::nullopt;
  if (choices.size() == 1) return choices.front().next_hop;

  const std::vector<double> weight = weights(choices, config);
  double total = 0;
  for (const double w : weight) total += w;
  double left = random.uniform() * total;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    left -= weight[i];
    if (left < 0) return choices[i].next_hop;
  }
  return choices.back().next_hop;  // rounding left a crumb of probability over
}

}  // namespace hal::routing
