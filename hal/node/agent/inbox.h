#pragma once

#include <vector>

#include "hal/node/exchange/step.h"
#include "hal/types/route.h"
#include "hal/types/time.h"

namespace hal::node::agent {

/// Events and network changes that wait for the next exchange with one agent's controller. A change
/// travels with the first event at or after it.
class Inbox {
 public:
  void add(exchange::Event&& event);
  void add(Time at, RouteChange change) { routes_.push_back({at, std::move(change)}); }
  void add(Time at, const Neighbour& neighbour) { neighbours_.push_back({at, {neighbour, false}}); }
  void add_lost(Time at, AgentId neighbour) {
    neighbours_.push_back({at, {{.id = neighbour, .last_heard = {}, .rssi_dbm = 0}, true}});
  }

  bool empty() const { return events_.empty(); }

  /// Takes the events by (time, cause, arrival), with the changes they carry. An event carries only
  /// the latest change of a neighbour: last heard, or lost. Changes later than the last event
  /// remain.
  /// @param to  the events are appended to it.
  void take(std::vector<exchange::Event>& to);

 private:
  template <class T>
  struct At {
    Time time;
    T value;
  };
  struct NeighbourChange {
    Neighbour neighbour;
    bool lost = false;
  };

  void move_neighbours(exchange::Event& event);

  std::vector<exchange::Event> events_;
  std::vector<At<RouteChange>> routes_;
  std::vector<At<NeighbourChange>> neighbours_;
};

}  // namespace hal::node::agent
