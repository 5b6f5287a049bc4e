#pragma once

#include <map>
#include <vector>

#include "hal/routing/node.h"

namespace hal::routing {

/// Who was heard directly and has not failed to answer since.
class Neighbourhood {
 public:
  explicit Neighbourhood(Node& node) : node_(node) {}

  void on_heard(const Reception& reception) {
    Neighbour& neighbour = known_[reception.from];
    neighbour = {.id = reception.from, .last_heard = node_.now(), .rssi_dbm = reception.rssi_dbm};
    node_.ports.observer.on_neighbour(neighbour);
  }

  /// Reported once per loss, however many frames to it were under way.
  void on_no_answer(AgentId neighbour) {
    if (known_.erase(neighbour) > 0) node_.ports.observer.on_neighbour_lost(neighbour);
  }

  /// By address.
  std::vector<Neighbour> known() const {
    std::vector<Neighbour> all;
    for (const auto& [id, neighbour] : known_) all.push_back(neighbour);
    return all;
  }

 private:
  Node& node_;
  std::map<AgentId, Neighbour> known_;
};

}  // namespace hal::routing
