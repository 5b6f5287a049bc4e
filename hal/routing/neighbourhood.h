#pragma once

#include <algorithm>
#include <vector>

#include "hal/routing/node.h"

namespace hal::routing {

/// Who was heard directly and has not failed to answer since.
class Neighbourhood {
 public:
  explicit Neighbourhood(Node& node) : node_(node) {}

  void on_heard(const Reception& reception) {
    const auto place = std::ranges::lower_bound(known_, reception.from, {}, &Neighbour::id);
    const bool is_known = place != known_.end() && place->id == reception.from;
    Neighbour& neighbour = is_known ? *place : *known_.insert(place, Neighbour{});
    neighbour = {.id = reception.from, .last_heard = node_.now(), .rssi_dbm = reception.rssi_dbm};
    node_.ports.observer.on_neighbour(neighbour);
  }

  /// Reported once per loss, however many frames to it were under way.
  void on_no_answer(AgentId neighbour) {
    const auto place = std::ranges::lower_bound(known_, neighbour, {}, &Neighbour::id);
    if (place == known_.end() || place->id != neighbour) return;
    known_.erase(place);
    node_.ports.observer.on_neighbour_lost(neighbour);
  }

  /// By address.
  const std::vector<Neighbour>& known() const { return known_; }

 private:
  Node& node_;
  std::vector<Neighbour> known_;  ///< By address. Some twenty, asked for with every frame.
};

}  // namespace hal::routing
