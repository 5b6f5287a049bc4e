#include "gateway/runtime/route_view.h"

#include <algorithm>

namespace gateway::runtime {

bool RouteView::is_watched(const std::string& topic) const {
  return std::ranges::find(watched_, topic) != watched_.end();
}

void RouteView::take_in(const hal::node::exchange::Event& event) {
  for (const auto& [route, removed] : event.routes) {
    if (!is_watched(route.topic)) continue;
    const Key key{route.topic, route.destination, route.next_hop};
    if (removed) {
      table_.erase(key);
    } else {
      table_[key] = route.path;
    }
  }
  if (!keeps_neighbours_) return;
  for (const hal::Neighbour& neighbour : event.neighbours) update_neighbour(neighbour);
  for (const hal::AgentId lost : event.lost_neighbours) {
    std::erase_if(neighbours_, [&](const hal::Neighbour& n) { return n.id == lost; });
  }
}

void RouteView::update_neighbour(const hal::Neighbour& neighbour) {
  const auto place = std::ranges::lower_bound(neighbours_, neighbour.id, {}, &hal::Neighbour::id);
  if (place != neighbours_.end() && place->id == neighbour.id) {
    *place = neighbour;
  } else {
    neighbours_.insert(place, neighbour);
  }
}

std::vector<hal::Route> RouteView::routes(std::string_view topic, hal::AgentId destination) const {
  std::vector<hal::Route> found;
  auto entry = table_.lower_bound(Key{topic, destination, hal::AgentId{0}});
  for (; entry != table_.end(); ++entry) {
    const auto& [of_topic, to, next_hop] = entry->first;
    if (of_topic != topic || to != destination) break;
    found.push_back({of_topic, to, next_hop, entry->second});
  }
  return found;
}

void RouteView::forget(std::string_view topic, hal::AgentId destination) {
  std::erase_if(table_, [&](const auto& entry) {
    return std::get<0>(entry.first) == topic && std::get<1>(entry.first) == destination;
  });
}

}  // namespace gateway::runtime
