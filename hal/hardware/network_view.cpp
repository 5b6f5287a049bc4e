#include "hal/hardware/network_view.h"

#include <algorithm>
#include <utility>

namespace hal::hardware {

bool NetworkView::is_watched(const std::string& topic) const {
  return std::ranges::find(wants_.watched, topic) != wants_.watched.end();
}

void NetworkView::on_route_change(const RouteChange& change) {
  const Route& route = change.route;
  const Key key{route.topic, route.destination, route.next_hop};
  if (change.removed) {
    routes_.erase(key);
  } else {
    routes_[key] = route;
  }
  if (is_watched(route.topic)) new_routes_.push_back(change);
}

bool NetworkView::on_neighbour(const Neighbour& neighbour) {
  neighbours_[neighbour.id] = neighbour;
  if (!wants_.neighbours) return false;
  heard_.insert(neighbour.id);
  lost_.erase(neighbour.id);
  return told_.insert(neighbour.id).second;
}

bool NetworkView::on_neighbour_lost(AgentId neighbour) {
  neighbours_.erase(neighbour);
  if (!wants_.neighbours || told_.erase(neighbour) == 0) return false;
  heard_.erase(neighbour);
  lost_.insert(neighbour);
  return true;
}

void NetworkView::start_anew(const Wants& wants) {
  wants_ = wants;
  new_routes_.clear();
  heard_.clear();
  lost_.clear();
  told_.clear();
  for (const auto& [key, route] : routes_) {
    if (is_watched(route.topic)) new_routes_.push_back({route, false});
  }
  if (!wants_.neighbours) return;
  for (const auto& [id, neighbour] : neighbours_) {
    heard_.insert(id);
    told_.insert(id);
  }
}

void NetworkView::tell(exchange::Event& event) {
  event.routes = std::exchange(new_routes_, {});
  for (const AgentId id : heard_) event.neighbours.push_back(neighbours_.at(id));
  event.lost_neighbours.assign(lost_.begin(), lost_.end());
  heard_.clear();
  lost_.clear();
}

}  // namespace hal::hardware
