#include "hal/node/routing/route_table.h"

namespace hal::node::routing {

void RouteTable::install(const Route& route) {
  if (classes_.size() >= kMostClasses && !classes_.contains(route.topic)) return;
  Paths& paths = classes_[route.topic][route.destination];
  const auto [entry, is_new] = paths.try_emplace(route.next_hop, route.path);
  if (!is_new && entry->second == route.path) return;
  entry->second = route.path;
  observer_.on_route_change({.route = route, .removed = false});
}

void RouteTable::remove(std::string_view topic, AgentId destination) {
  const auto destinations = classes_.find(topic);
  if (destinations == classes_.end()) return;
  const auto removed = destinations->second.extract(destination);
  if (destinations->second.empty()) classes_.erase(destinations);
  if (removed.empty()) return;
  for (const auto& [next_hop, path] : removed.mapped()) {
    report_removed(topic, destination, next_hop);
  }
}

void RouteTable::remove_via(AgentId next_hop) {
  for (auto& [topic, destinations] : classes_) {
    for (auto& [destination, paths] : destinations) {
      if (paths.erase(next_hop) > 0) report_removed(topic, destination, next_hop);
    }
    std::erase_if(destinations, [](const auto& entry) { return entry.second.empty(); });
  }
  std::erase_if(classes_, [](const auto& entry) { return entry.second.empty(); });
}

std::vector<Route> RouteTable::routes(std::string_view topic, AgentId destination) const {
  std::vector<Route> found;
  const auto destinations = classes_.find(topic);
  if (destinations == classes_.end()) return found;
  const auto paths = destinations->second.find(destination);
  if (paths == destinations->second.end()) return found;
  for (const auto& [next_hop, path] : paths->second) {
    found.push_back({std::string(topic), destination, next_hop, path});
  }
  return found;
}

std::vector<Route> RouteTable::routes() const {
  std::vector<Route> found;
  for (const auto& [topic, destinations] : classes_) {
    for (const auto& [destination, paths] : destinations) {
      for (const auto& [next_hop, path] : paths) {
        found.push_back({topic, destination, next_hop, path});
      }
    }
  }
  return found;
}

void RouteTable::report_removed(std::string_view topic, AgentId destination,
                                AgentId next_hop) const {
  observer_.on_route_change(
      {.route = {std::string(topic), destination, next_hop, {}}, .removed = true});
}

}  // namespace hal::node::routing
