#include "sim/scenario/ip_route_table.h"

#include "sim/scenario/ip_network.h"

namespace sim::scenario {

using hal::files::description::RouteHop;

bool IpRouteTable::is_direct(std::size_t agent, std::uint32_t address) const {
  for (const auto& [to, hop] : hops_) {
    if (to.agent == agent && hop.via == agent) return true;
    if (!to.agent && !hop.via && is_within(to.network, address)) return true;
  }
  return false;
}

std::optional<RouteHop> IpRouteTable::hop(std::size_t to, std::uint32_t address,
                                          const air::NetworkConfig& own) const {
  const auto to_agent = hops_.find({.agent = to, .network = {}});
  if (to_agent != hops_.end()) return RouteHop{*to_agent->second.via, to_agent->second.row};
  std::optional<RouteHop> best;
  int longest = -1;
  if ((own.address ^ address) >> (32 - own.prefix) == 0) {
    longest = own.prefix;
    best = RouteHop{to, 0};
  }
  for (const auto& [network, hop] : hops_) {
    const bool is_it = !network.agent && is_within(network.network, address);
    if (!is_it || network.network.prefix <= longest) continue;
    longest = network.network.prefix;
    best = RouteHop{hop.via.value_or(to), hop.row};
  }
  return best;
}

void IpRouteTable::mark_forwarding(std::vector<bool>& agents) const {
  for (const auto& [to, hop] : hops_) {
    if (hop.via && hop.via != to.agent) agents[*hop.via] = true;
  }
}

std::vector<air::IpRoute> IpRouteTable::routes(
    const std::vector<agents::AgentConfig>& agents) const {
  std::vector<air::IpRoute> all;
  for (const auto& [to, hop] : hops_) {
    air::IpRoute route{.network = to.network};
    if (to.agent) route.to = agents[*to.agent].id;
    if (hop.via) route.via = agents[*hop.via].id;
    all.push_back(route);
  }
  return all;
}

}  // namespace sim::scenario
