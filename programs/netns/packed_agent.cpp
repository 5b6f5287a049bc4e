#include "programs/netns/packed_agent.h"

#include <string_view>

namespace programs::netns {
namespace {

void pack_route(Packer& out, const KernelRoute& route) {
  out.put(route.is_ipv6);
  out.put(route.prefix);
  for (const std::uint8_t octet : route.destination) out.put(octet);
  out.put(route.via);
  out.put(route.gateway);
}

KernelRoute unpacked_route(Unpacker& in) {
  KernelRoute route;
  route.is_ipv6 = in.number<int>() != 0;
  route.prefix = in.number<int>();
  for (std::uint8_t& octet : route.destination) octet = in.number<std::uint8_t>();
  route.via = in.number<std::uint16_t>();
  route.gateway = in.number<std::uint32_t>();
  return route;
}

}  // namespace

void pack(Packer& out, const AgentNetwork& agent) {
  out.put(std::string_view(agent.agent));
  out.put(agent.id);
  out.put(agent.address);
  out.put(agent.prefix);
  out.put(agent.mtu);
  out.put(agent.forwards);
  out.put(agent.routes.size());
  for (const KernelRoute& route : agent.routes) pack_route(out, route);
}

AgentNetwork unpacked_agent(Unpacker& in) {
  AgentNetwork agent;
  agent.agent = in.text();
  agent.id = in.number<std::uint16_t>();
  agent.address = in.number<std::uint32_t>();
  agent.prefix = in.number<int>();
  agent.mtu = in.number<int>();
  agent.forwards = in.number<int>() != 0;
  for (auto left = in.number(); left > 0; --left) agent.routes.push_back(unpacked_route(in));
  return agent;
}

}  // namespace programs::netns
