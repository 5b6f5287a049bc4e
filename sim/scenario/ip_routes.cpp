#include "sim/scenario/ip_routes.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "hal/files/description/route_names.h"
#include "hal/files/description/routes_to.h"
#include "sim/radio/radio_config.h"
#include "sim/scenario/ip_network.h"
#include "sim/scenario/ip_route_table.h"
#include "sim/scenario/program.h"

namespace sim::scenario {
namespace {

using hal::files::description::is_pattern;
using hal::files::description::NamedAgent;
using hal::files::description::RouteFindings;
using hal::files::description::RouteHop;
using hal::files::description::RouteNames;
using hal::files::description::RoutesTo;
using hal::node::routing::StaticRow;

using Index = std::size_t;  ///< Of an agent among all of the scenario.

constexpr const char* kDefault = "default";

/// The routes of all agents, made row by row.
class IpRoutes {
 public:
  explicit IpRoutes(Scenario& scenario)
      : config_(scenario.simulation), tables_(config_.agents.size()) {
    for (const agents::AgentConfig& agent : config_.agents)
      names_.push_back({agent.name, agent.id});
  }

  void add(const Group& group, Mapping network) {
    std::vector<Mapping> items = network.items("routes");
    if (items.size() != group.ip_routes.size()) return;  // a mistake that was noted before
    for (std::size_t i = 0; i < items.size(); ++i) {
      rows_.push_back(items[i]);
      RouteNames names(rows_.back(), names_);
      apply(names, group.ip_routes[i], group);
      is_good_ = is_good_ && names.is_good();
    }
  }

  /// Gives the routes to the agents, if they are all right.
  void finish() {
    if (!is_good_) return;
    for (Index agent = 0; agent < tables_.size(); ++agent) check_hops(agent);
    if (!is_good_ || has_loops()) return;
    std::vector<bool> forwards(tables_.size(), false);
    for (const IpRouteTable& table : tables_) table.mark_forwarding(forwards);
    for (Index agent = 0; agent < tables_.size(); ++agent) {
      if (forwards[agent]) add_neighbours(agent);
      auto& network = config_.agents[agent].network;
      if (!network) continue;
      network->forwards = forwards[agent];
      network->routes = tables_[agent].routes(config_.agents);
    }
  }

 private:
  bool has_network(Index agent) const { return config_.agents[agent].network.has_value(); }
  const air::NetworkConfig& network_of(Index agent) const { return *config_.agents[agent].network; }

  void apply(RouteNames& names, const StaticRow& row, const Group& group) {
    if (!row.path.empty()) return apply_path(names, row, group);
    if (row.to.empty()) return;  // noted when it was read
    const std::vector<Index> at = of_group(names, row, group);
    std::optional<Index> via;
    if (!row.via.empty()) via = names.via(row.via);
    if (via && !has_network(*via)) names.mistake("via", fmt::format("{} has no network", row.via));
    const std::vector<IpDestination> to = destinations(names, row.to);
    if (!names.is_good()) return;
    const int count = set(names, at, to, via);
    if (count > 0 || !names.is_good()) return;
    const bool is_via = at.size() == 1 && via == at.front();
    names.mistake(is_via ? "via" : "to", is_via ? fmt::format("{} would send to itself", row.via)
                                                : "gives no agent a route to another one");
  }

  /// @return number of routes to other agents, or to networks.
  int set(RouteNames& names, const std::vector<Index>& at, const std::vector<IpDestination>& to,
          std::optional<Index> via) {
    int count = 0;
    for (const Index agent : at) {
      if (agent == via) continue;
      for (const IpDestination& one : to) count += set(names, agent, one, via) ? 1 : 0;
    }
    return count;
  }

  /// @return whether it is a route to another agent, or to a network.
  bool set(RouteNames& names, Index agent, const IpDestination& to, std::optional<Index> via) {
    if (to.agent == agent) return false;
    const air::NetworkConfig& own = network_of(agent);
    if (!to.agent && own.prefix == to.network.prefix && is_within(to.network, own.address)) {
      names.mistake("to",
                    fmt::format("is the network of {} itself; name agents, or a longer prefix",
                                config_.agents[agent].name));
      return false;
    }
    tables_[agent].set(to, {via ? via : to.agent, rows_.size() - 1});
    return true;
  }

  void apply_path(RouteNames& names, const StaticRow& row, const Group& group) {
    const std::vector<Index> path = names.path(row.path);
    for (const Index one : path) {
      if (!has_network(one))
        names.mistake("path", fmt::format("{} has no network", config_.agents[one].name));
    }
    if (!names.is_good()) return;
    for (std::size_t from = 0; from < path.size(); ++from) {
      if (!is_in(group, path[from])) continue;
      for (std::size_t to = 0; to < path.size(); ++to) {
        if (from == to) continue;
        const Index next = path[to > from ? from + 1 : from - 1];
        tables_[path[from]].set({.agent = path[to]}, {next, rows_.size() - 1});
      }
    }
  }

  bool is_in(const Group& group, Index agent) const {
    return std::ranges::find(group.agents, config_.agents[agent].id) != group.agents.end();
  }

  std::vector<Index> of_group(RouteNames& names, const StaticRow& row, const Group& group) {
    std::vector<Index> at = names.meant("at", row.at);
    const std::size_t before = at.size();
    std::erase_if(at, [&](Index agent) { return !is_in(group, agent); });
    if (at.empty() && before > 0)
      names.mistake("at", fmt::format("'{}' is not of this group", row.at));
    return at;
  }

  std::vector<IpDestination> destinations(RouteNames& names, const std::string& to) const {
    if (to == kDefault) return {{.network = everything(false)}, {.network = everything(true)}};
    if (to.find('/') != std::string::npos) {
      const auto network = parsed_network(to);
      if (network) return {{.network = *network}};
      names.mistake("to",
                    fmt::format("'{}' is not a network, e.g. 10.77.0.0/16; no bits may be set "
                                "beyond its prefix",
                                to));
      return {};
    }
    std::vector<IpDestination> agents;
    for (const Index one : names.meant("to", to)) {
      if (has_network(one)) agents.push_back({.agent = one});
    }
    if (agents.empty() && names.is_good())
      names.mistake("to", fmt::format("{} has no network", to));
    return agents;
  }

  std::uint32_t channel_of(Index agent) const {
    const radio::WavesConfig* const waves = radio::waves_of(config_.radio);
    const std::uint32_t common = waves == nullptr ? 0 : waves->phy.channel;
    return config_.agents[agent].radio.channel.value_or(common);
  }

  /// Notes next hops that the agent cannot reach directly.
  void check_hops(Index agent) {
    for (const auto& [to, hop] : tables_[agent].hops()) {
      if (!hop.via || noted_.contains(hop.row)) continue;
      const std::string why = obstacle(agent, *hop.via);
      if (why.empty()) continue;
      is_good_ = false;
      noted_.insert(hop.row);
      rows_[hop.row].mistake(rows_[hop.row].has("via") ? "via" : "", why);
    }
  }

  /// Why an agent cannot be the next hop of another; empty if it can.
  std::string obstacle(Index agent, Index via) const {
    const std::string& from = config_.agents[agent].name;
    const std::string& to = config_.agents[via].name;
    if (channel_of(agent) != channel_of(via)) {
      return fmt::format("{} is on channel {} and {} on channel {}", to, channel_of(via), from,
                         channel_of(agent));
    }
    const air::NetworkConfig& own = network_of(agent);
    const std::uint32_t address = network_of(via).address;
    const std::uint32_t different = own.address ^ address;
    if (different >> (32 - own.prefix) == 0 || tables_[agent].is_direct(via, address)) return {};
    return fmt::format(
        "{} has the address {}, which is not on the network {}/{} of {}, and {} has "
        "no direct route to it",
        to, dotted(address), dotted(own.address), own.prefix, from, from);
  }

  /// By the longest prefix, as the kernel decides. Of IPv4; the routes to agents are the same in
  /// IPv6.
  std::optional<RouteHop> hop(Index agent, Index to) const {
    if (agent == to || !has_network(agent)) return std::nullopt;
    const air::NetworkConfig& own = network_of(agent);
    return tables_[agent].hop(to, network_of(to).address, own);
  }

  bool has_loops() {
    std::vector<std::string> names;
    names.reserve(names_.size());
    for (const NamedAgent& agent : names_) names.push_back(agent.name);
    RouteFindings findings(rows_);
    for (Index to = 0; to < names.size(); ++to) {
      if (!has_network(to)) continue;
      std::vector<std::optional<RouteHop>> hops;
      hops.reserve(names.size());
      for (Index agent = 0; agent < names.size(); ++agent) hops.push_back(hop(agent, to));
      findings.add(RoutesTo(to, std::move(hops), names).findings());
    }
    return findings.has_mistake();
  }

  /// Direct routes to all that the agent reaches without a row. For IPv6 they are via link-local
  /// addresses, as all routes are here, and a kernel sends no redirect to a source that it reaches
  /// by such a route: there is no setting that forbids redirects of IPv6.
  void add_neighbours(Index agent) {
    for (Index to = 0; to < tables_.size(); ++to) {
      if (to == agent || !has_network(to)) continue;
      const auto way = hop(agent, to);
      if (way && way->via == to && !tables_[agent].has(to))
        tables_[agent].set({.agent = to}, {to, 0});
    }
  }

  agents::SimulationConfig& config_;
  std::vector<NamedAgent> names_;
  std::vector<IpRouteTable> tables_;  ///< By agent.
  std::vector<Mapping> rows_;
  std::set<std::size_t> noted_;  ///< Rows with a mistake of check_hops().
  bool is_good_ = true;
};

void row_keys(Fields& io, StaticRow& row) {
  io.text({"at", "Agents of the group that have the route: a name, or a pattern with *.", "NAME0"},
          row.at);
  io.needed_text(
      {"to",
       "Destination: an agent's name, or a pattern with *, for its addresses of IPv4 and "
       "IPv6; a network, such as 10.78.0.0/16; or `default`.",
       "NAME2"},
      row.to);
  io.given_text({"via",
                 "Agent to which the packets are sent first, and which forwards them; without it, "
                 "they are sent directly to their destination.",
                 "NAME1"},
                row.via);
}

}  // namespace

void ip_routes_key(Fields& io, std::vector<StaticRow>& rows) {
  io.list_if_any<StaticRow>(
      {"routes",
       "Routes of IP in the agents' network namespaces, besides the one to their own network, "
       "where "
       "all other agents are neighbours. If several items give an agent a route to the same "
       "destination, the last one counts; an agent gets none to or via itself. Agents that are "
       "`via` forward packets.",
       "[{to: NAME2, via: NAME1}, {path: [NAME0, NAME1, NAME2]}]"},
      rows, [](Fields& one, StaticRow& row) {
        const bool is_path = row.to.empty();
        const auto path = [&row](Fields& keys) {
          keys.texts(
              {"path",
               "Agents along which packets travel in both directions; those of the group get "
               "the routes to all others. A pattern stands for the agents that match it, by "
               "address.",
               "[NAME0, NAME1, NAME2]"},
              row.path);
        };
        const auto hop = [&row](Fields& keys) { row_keys(keys, row); };
        if (one.first_of({{"path", is_path, path}, {"to", !is_path, hop}})) return;
        one.mistake("", "must have either `to` or `path`");
        if (one.reading() != nullptr) one.reading()->leave_rest();
      });
}

void find_ip_routes(Mapping& in, Scenario& scenario) {
  IpRoutes routes(scenario);
  for (const Group& group : scenario.groups) {
    if (group.ip_routes.empty()) continue;
    routes.add(group, in.within("agents").within(group.name).within("network"));
  }
  routes.finish();
}

}  // namespace sim::scenario
