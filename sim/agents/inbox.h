#pragma once

#include <vector>

#include "hal/exchange/step.h"
#include "hal/types/route.h"
#include "hal/types/time.h"

namespace sim::agents {

/// What waits for the next exchange with one agent's controller: events, and the changes of its
/// network that travel with the first event at or after them.
class Inbox {
 public:
  void add(hal::exchange::Event event) { events_.push_back(std::move(event)); }
  void add(hal::Time at, hal::RouteChange change) { routes_.push_back({at, std::move(change)}); }
  void add(hal::Time at, const hal::Neighbour& neighbour) {
    neighbours_.push_back({at, neighbour});
  }
  void add_lost(hal::Time at, hal::AgentId neighbour) { lost_.push_back({at, neighbour}); }

  bool empty() const { return events_.empty(); }

  /// The events by (time, cause, arrival), with the changes in them. Changes later than the last
  /// event stay.
  std::vector<hal::exchange::Event> take();

 private:
  template <class T>
  struct At {
    hal::Time time;
    T value;
  };

  std::vector<hal::exchange::Event> events_;
  std::vector<At<hal::RouteChange>> routes_;
  std::vector<At<hal::Neighbour>> neighbours_;
  std::vector<At<hal::AgentId>> lost_;
};

}  // namespace sim::agents
