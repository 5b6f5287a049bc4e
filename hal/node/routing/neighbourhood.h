#pragma once

#include <algorithm>
#include <vector>

#include "hal/node/routing/ports.h"
#include "hal/types/prefetch.h"

namespace hal::node::routing {

/// The nodes that were heard directly and have acknowledged all frames since.
class Neighbourhood {
 public:
  Neighbourhood(Timers& timers, RoutingObserver& observer) : timers_(timers), observer_(observer) {}

  /// Prefetches what on_heard() looks through.
  void prefetch() const { hal::prefetch(known_); }

  void on_heard(const Reception& reception) {
    const auto place = std::ranges::lower_bound(known_, reception.from, {}, &Neighbour::id);
    const bool is_known = place != known_.end() && place->id == reception.from;
    Neighbour& neighbour = is_known ? *place : *known_.insert(place, Neighbour{});
    neighbour = {.id = reception.from, .last_heard = timers_.now(), .rssi_dbm = reception.rssi_dbm};
    observer_.on_neighbour(neighbour);
  }

  /// Reported once per loss, for any number of frames under way.
  void on_no_answer(AgentId neighbour) {
    const auto place = std::ranges::lower_bound(known_, neighbour, {}, &Neighbour::id);
    if (place == known_.end() || place->id != neighbour) return;
    known_.erase(place);
    observer_.on_neighbour_lost(neighbour);
    observer_.on_protocol_event(ProtocolEvent::kNeighbourLost);
  }

  /// By address.
  const std::vector<Neighbour>& known() const { return known_; }

 private:
  Timers& timers_;
  RoutingObserver& observer_;
  std::vector<Neighbour> known_;  ///< By address. About twenty entries, looked up for every frame.
};

}  // namespace hal::node::routing
