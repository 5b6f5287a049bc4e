#include "hal/files/description/routes_to.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace hal::files::description {

RoutesTo::RoutesTo(std::size_t destination, std::vector<std::optional<RouteHop>> hops,
                   const std::vector<std::string>& names)
    : destination_(destination), hops_(std::move(hops)), names_(names), lengths_(names.size()) {
  for (std::size_t agent = 0; agent < names.size(); ++agent) {
    measure(agent);
    note_end(agent);
  }
}

/// Follows the hops from an agent, and notes the number of links for all agents on the way.
void RoutesTo::measure(std::size_t agent) {
  std::vector<std::size_t> way;
  while (agent != destination_ && !lengths_[agent]) {
    if (std::ranges::find(way, agent) != way.end()) return note_loop(way, agent);
    way.push_back(agent);
    if (!hops_[agent]) break;
    agent = hops_[agent]->via;
  }
  std::uint16_t length = agent == destination_ ? 0 : lengths_[agent].value_or(0);
  const bool leads_there = agent == destination_ || length > 0;
  for (auto one = way.rbegin(); one != way.rend(); ++one) {
    if (leads_there) ++length;
    lengths_[*one] = length;
  }
}

/// The way has come back to an agent on it.
void RoutesTo::note_loop(const std::vector<std::size_t>& way, std::size_t again) {
  std::vector<std::string> names;
  for (auto one = std::ranges::find(way, again); one != way.end(); ++one)
    names.push_back(names_[*one]);
  names.push_back(names_[again]);
  findings_.push_back({hops_[way.back()]->row, true,
                       fmt::format("routes to {} lead in a loop: {}", names_[destination_],
                                   fmt::join(names, " -> "))});
  for (const std::size_t one : way) lengths_[one] = 0;
}

/// Notes a next hop that has no route itself.
void RoutesTo::note_end(std::size_t agent) {
  const std::optional<RouteHop>& hop = hops_[agent];
  if (!hop || hop->via == destination_ || hops_[hop->via]) return;
  findings_.push_back(
      {hop->row, false,
       fmt::format("{} has no route to {}: what {} sends there ends at {}", names_[hop->via],
                   names_[destination_], names_[agent], names_[hop->via])});
}

void RouteFindings::add(const std::vector<RouteFinding>& found) {
  for (const RouteFinding& one : found) {
    has_mistake_ = has_mistake_ || one.is_mistake;
    if (!noted_.insert({one.row, one.is_mistake}).second) continue;
    if (one.is_mistake) {
      rows_[one.row].mistake("", one.what);
    } else {
      rows_[one.row].warn("", one.what);
    }
  }
}

}  // namespace hal::files::description
