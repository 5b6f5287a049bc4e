#pragma once

#include <cstdint>
#include <string>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"

namespace hal {

/// Statistics of a path: the tuple of the routing tables (Labella, Dietrich, Dressler, "Hybrid
/// simulation of Sensor and Actor Networks with BARAKA", 2009, section 6.1).
struct PathStatistics {
  std::uint16_t hops = 0;  ///< Number of links; 1: a neighbour.
  Duration delay{};        ///< >= 0, sum of the expected delays of the hops.
  double min_snr_db = 0;   ///< dB, SNR of the weakest link; 0 if the link does not report SNR.
  double energy = 0;       ///< J, >= 0, to transmit one packet along the path.
  bool operator==(const PathStatistics&) const = default;  ///< Member by member.
};

/// An entry in the routing table of one agent: `destination` can be reached via `next_hop`.
struct Route {
  std::string topic;                              ///< Message class of the table.
  AgentId destination;                            ///< End of the path.
  AgentId next_hop;                               ///< First node on the path, a neighbour.
  PathStatistics path;                            ///< From this agent to `destination`.
  bool operator==(const Route&) const = default;  ///< Member by member.
};

/// An entry that was added, changed or removed.
struct RouteChange {
  Route route;           ///< The entry after the change.
  bool removed = false;  ///< The entry was removed; `route.path` has no meaning.
  bool operator==(const RouteChange&) const = default;  ///< Member by member.
};

/// A node whose frames this agent receives directly.
struct Neighbour {
  AgentId id;           ///< Address of the node.
  Time last_heard{};    ///< End of the last frame that was received from it.
  double rssi_dbm = 0;  ///< dBm, received power of that frame; 0 if the link does not report it.
  bool operator==(const Neighbour&) const = default;  ///< Member by member.
};

}  // namespace hal
