#pragma once

#include <cstdint>
#include <string>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"

namespace hal {

/// Statistics of a path: the tuple of the routing tables (Labella, Dietrich, Dressler, "Hybrid
/// simulation of Sensor and Actor Networks with BARAKA", 2009, section 6.1).
struct PathStatistics {
  std::uint16_t hops = 0;
  Duration delay{};       ///< Sum of the hops' expected delays.
  double min_snr_db = 0;  ///< Weakest link of the path.
  double energy = 0;      ///< J, to transmit one packet along the path.
  bool operator==(const PathStatistics&) const = default;
};

/// One entry of one agent's table: `destination` can be reached via `next_hop`.
struct Route {
  std::string topic;
  AgentId destination;
  AgentId next_hop;
  PathStatistics path;
  bool operator==(const Route&) const = default;
};

/// A difference between two states of a table. `removed`: the entry is gone, `route.path` is void.
struct RouteChange {
  Route route;
  bool removed = false;
  bool operator==(const RouteChange&) const = default;
};

/// A node that was heard directly.
struct Neighbour {
  AgentId id;
  Time last_heard{};
  double rssi_dbm = 0;
  bool operator==(const Neighbour&) const = default;
};

}  // namespace hal
