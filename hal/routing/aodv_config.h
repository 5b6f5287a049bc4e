#pragma once

#include <algorithm>

#include "hal/types/time.h"

namespace hal::routing {

/// Parameters of AODV by the names of C. Perkins, E. Belding-Royer, S. Das, "Ad hoc On-Demand
/// Distance Vector (AODV) Routing", RFC 3561, 2003, section 10, with its defaults.
struct AodvConfig {
  Duration active_route_timeout = std::chrono::seconds{3};  ///< > 0.
  int allowed_hello_loss = 2;                               ///< >= 1.
  Duration hello_interval = std::chrono::seconds{1};        ///< > 0.
  int local_add_ttl = 2;                                    ///< >= 0.
  int net_diameter = 35;                                    ///< 1..255, hops.
  /// > 0. Conservative estimate of a hop's time: queue, processing, medium.
  Duration node_traversal_time = std::chrono::milliseconds{40};
  int rerr_ratelimit = 10;  ///< >= 1, per second.
  int rreq_ratelimit = 10;  ///< >= 1, per second.
  int rreq_retries = 2;     ///< >= 0.
  int timeout_buffer = 2;   ///< >= 0.
  int ttl_start = 1;        ///< >= 1.
  int ttl_increment = 2;    ///< >= 1.
  int ttl_threshold = 7;    ///< >= 1.

  // What the RFC leaves to the node.
  bool hello = true;              ///< Section 6.9; else only the link tells of lost neighbours.
  bool destination_only = false;  ///< Flag 'D' of a RREQ, section 5.1.
  bool gratuitous_reply = true;   ///< Flag 'G' of a RREQ, section 6.6.3.
  bool local_repair = false;      ///< Section 6.12.
  bool wait_after_start = false;  ///< Section 6.13: DELETE_PERIOD without answers after a start.

  // What follows from them.
  Duration net_traversal_time() const { return 2 * node_traversal_time * net_diameter; }
  Duration path_discovery_time() const { return 2 * net_traversal_time(); }
  Duration my_route_timeout() const { return 2 * active_route_timeout; }
  Duration next_hop_wait() const { return node_traversal_time + std::chrono::milliseconds{10}; }
  Duration blacklist_timeout() const { return std::max(1, rreq_retries) * net_traversal_time(); }
  int max_repair_ttl() const { return std::max(1, net_diameter * 3 / 10); }
  /// K = 5, which the RFC recommends.
  Duration delete_period() const { return 5 * std::max(active_route_timeout, hello_interval); }
  /// RING_TRAVERSAL_TIME of a RREQ with that TTL.
  Duration ring_traversal_time(int ttl) const {
    return 2 * node_traversal_time * (ttl + timeout_buffer);
  }
};

}  // namespace hal::routing
