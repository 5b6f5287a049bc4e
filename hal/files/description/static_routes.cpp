#include "hal/files/description/static_routes.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "hal/files/description/routes_to.h"

namespace hal::files::description {
namespace {

using config::Mapping;
using node::routing::StaticRoute;
using node::routing::StaticRow;

using Index = std::size_t;  ///< Of an agent.
using Agents = std::span<const NamedAgent>;

/// A row with the agents that its names stand for, in the order of the agents.
struct MeantRow {
  std::vector<Index> at{}, to{};
  std::optional<Index> via{};  ///< nullopt: the destination.
  std::vector<Index> path{};
};

/// The agents that a row means; nullopt after a mistake.
std::optional<MeantRow> understood(Mapping& in, const StaticRow& row, Agents agents) {
  RouteNames names(in, agents);
  MeantRow result;
  if (!row.path.empty()) {
    result.path = names.path(row.path);
  } else if (!row.to.empty()) {  // else noted when it was read
    result.at = names.meant("at", row.at);
    result.to = names.meant("to", row.to);
    if (!row.via.empty()) result.via = names.via(row.via);
    const bool is_one = !is_pattern(row.at) && names.is_good();
    if (is_one && result.via == result.at.front())
      names.mistake("via", fmt::format("{} would send to itself", row.at));
    if (is_one && !is_pattern(row.to) && result.to == result.at)
      names.mistake("to", fmt::format("{} needs no route to itself", row.at));
  }
  return names.is_good() ? std::optional(std::move(result)) : std::nullopt;
}

/// The next hops of all agents to one destination.
class Hops {
 public:
  Hops(Index destination, const std::vector<MeantRow>& rows, std::size_t agents)
      : destination_(destination), hops_(agents) {
    for (std::size_t i = 0; i < rows.size(); ++i) apply(rows[i], i);
  }

  std::vector<std::optional<RouteHop>> take() { return std::move(hops_); }

 private:
  void apply(const MeantRow& row, std::size_t number) {
    if (!row.path.empty()) return apply_path(row.path, number);
    if (!std::ranges::binary_search(row.to, destination_)) return;
    for (const Index agent : row.at) {
      const Index via = row.via.value_or(destination_);
      if (agent != destination_ && agent != via) hops_[agent] = RouteHop{via, number};
    }
  }

  void apply_path(const std::vector<Index>& path, std::size_t number) {
    const auto end = std::ranges::find(path, destination_);
    if (end == path.end()) return;
    for (auto one = path.begin(); one != end; ++one) hops_[*one] = RouteHop{*(one + 1), number};
    for (auto one = end + 1; one != path.end(); ++one) hops_[*one] = RouteHop{*(one - 1), number};
  }

  Index destination_;
  std::vector<std::optional<RouteHop>> hops_;
};

}  // namespace

std::vector<std::vector<StaticRoute>> static_routes(Mapping routing,
                                                    const std::vector<StaticRow>& rows,
                                                    std::span<const NamedAgent> agents) {
  if (!routing.has("routes"))
    routing.mistake("routes", "is missing: static routing does not find routes by itself");
  std::vector<Mapping> items = routing.items("routes");
  if (items.size() != rows.size()) return {};  // a mistake that was noted when they were read
  std::vector<MeantRow> found;
  bool is_good = true;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    auto row = understood(items[i], rows[i], agents);
    is_good = is_good && row.has_value();
    found.push_back(std::move(row).value_or(MeantRow{}));
  }
  if (!is_good) return {};
  std::vector<std::string> names;
  for (const NamedAgent& agent : agents) names.push_back(agent.name);
  std::vector<std::vector<StaticRoute>> all(agents.size());
  RouteFindings findings(items);
  for (Index to = 0; to < agents.size(); ++to) {
    const RoutesTo routes(to, Hops(to, found, agents.size()).take(), names);
    findings.add(routes.findings());
    for (Index agent = 0; agent < agents.size(); ++agent) {
      if (const auto& hop = routes.hop(agent))
        all[agent].push_back({agents[to].id, agents[hop->via].id, routes.length(agent)});
    }
  }
  if (findings.has_mistake()) return {};
  return all;
}

}  // namespace hal::files::description
