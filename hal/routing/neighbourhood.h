#pragma once

#include <set>

#include "hal/routing/node.h"

namespace hal::routing {

/// Who was heard directly and has not failed to answer since.
class Neighbourhood {
 public:
  explicit Neighbourhood(Node& node) : node_(node) {}

  void on_heard(const Reception& reception) {
    known_.insert(reception.from);
    node_.ports.observer.on_neighbour(
        {.id = reception.from, .last_heard = node_.now(), .rssi_dbm = reception.rssi_dbm});
  }

  /// Reported once per loss, however many frames to it were under way.
  void on_no_answer(AgentId neighbour) {
    if (known_.erase(neighbour) > 0) node_.ports.observer.on_neighbour_lost(neighbour);
  }

 private:
  Node& node_;
  std::set<AgentId> known_;
};

}  // namespace hal::routing
