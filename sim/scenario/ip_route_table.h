#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "hal/files/description/routes_to.h"
#include "sim/agents/simulation_config.h"
#include "sim/air/network_config.h"

namespace sim::scenario {

/// An agent, with its addresses of IPv4 and IPv6, or a network.
struct IpDestination {
  std::optional<std::size_t> agent{};  ///< Its index; none: `network`.
  air::IpNetwork network{};
  auto operator<=>(const IpDestination&) const = default;
};

struct IpHop {
  std::optional<std::size_t> via{};  ///< Index of an agent; the destination, or none: directly.
  std::size_t row = 0;               ///< That gave it.
};

/// The routes of an agent, besides the one to its own network.
class IpRouteTable {
 public:
  /// Replaces a route to the same destination.
  void set(const IpDestination& to, IpHop hop) { hops_[to] = hop; }
  bool has(std::size_t agent) const { return hops_.contains({.agent = agent, .network = {}}); }
  const std::map<IpDestination, IpHop>& hops() const { return hops_; }

  /// Whether a route, other than that to the agent's own network, leads directly to this agent.
  /// @param address  its IPv4 address, in host order.
  bool is_direct(std::size_t agent, std::uint32_t address) const;

  /// The hop to an agent by the longest prefix, in IPv4; nullopt: there is no route.
  /// @param own  the network of the agent whose table this is.
  std::optional<hal::files::description::RouteHop> hop(std::size_t to, std::uint32_t address,
                                                       const air::NetworkConfig& own) const;

  /// Sets the elements of all next hops that are not the destination.
  void mark_forwarding(std::vector<bool>& agents) const;

  std::vector<air::IpRoute> routes(const std::vector<agents::AgentConfig>& agents) const;

 private:
  std::map<IpDestination, IpHop> hops_;
};

}  // namespace sim::scenario
