#include "baraka/run/network/kernel_routes.h"

#include <algorithm>

#include "hal/types/check.h"
#include "programs/netns/addresses.h"

namespace baraka::run::network {
namespace {

using programs::netns::KernelRoute;
using sim::agents::AgentConfig;
using sim::air::IpRoute;
using sim::air::NetworkConfig;

constexpr int kIpv4Bits = 32, kIpv6Bits = 128;

const NetworkConfig& network_of(hal::AgentId id, const std::vector<AgentConfig>& all) {
  const auto found = std::ranges::find(all, id, &AgentConfig::id);
  BARAKA_CHECK(found != all.end() && found->network);
  return *found->network;
}

bool speaks_ipv6(const NetworkConfig& network) { return network.mtu >= sim::air::kLeastMtuOfIpv6; }

KernelRoute to_ipv4_of(const NetworkConfig& to) {
  KernelRoute route{.prefix = kIpv4Bits};
  for (std::size_t i = 0; i < 4; ++i)
    route.destination[i] = static_cast<std::uint8_t>(to.address >> (24 - 8 * i));
  return route;
}

KernelRoute to_ipv6_of(hal::AgentId to) {
  return {.is_ipv6 = true,
          .prefix = kIpv6Bits,
          .destination = programs::netns::unique_local_address(to.value)};
}

/// The routes to one destination, of each version of IP, without their gateways.
std::vector<KernelRoute> destinations_of(const IpRoute& one, const std::vector<AgentConfig>& all) {
  if (one.to == hal::AgentId{}) {
    return {{.is_ipv6 = one.network.is_ipv6,
             .prefix = one.network.prefix,
             .destination = one.network.address}};
  }
  const NetworkConfig& destination = network_of(one.to, all);
  std::vector<KernelRoute> to{to_ipv4_of(destination)};
  if (speaks_ipv6(destination)) to.push_back(to_ipv6_of(one.to));
  return to;
}

}  // namespace

std::vector<KernelRoute> kernel_routes(const AgentConfig& agent,
                                       const std::vector<AgentConfig>& all) {
  std::vector<KernelRoute> routes;
  for (const IpRoute& one : agent.network->routes) {
    bool has_ipv6 = true;
    std::uint32_t gateway = 0;
    if (one.via != hal::AgentId{}) {
      const NetworkConfig& via = network_of(one.via, all);
      has_ipv6 = speaks_ipv6(via);
      if (one.via != one.to) gateway = via.address;
    }
    for (KernelRoute& route : destinations_of(one, all)) {
      route.via = one.via.value;
      route.gateway = gateway;
      if (has_ipv6 || !route.is_ipv6) routes.push_back(route);
    }
  }
  return routes;
}

}  // namespace baraka::run::network
