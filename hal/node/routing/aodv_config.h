#pragma once

#include <algorithm>

#include "hal/types/time.h"

namespace hal::node::routing {

/// Parameters of AODV, with the names and defaults of C. Perkins, E. Belding-Royer, S. Das, "Ad hoc
/// On-Demand Distance Vector (AODV) Routing", RFC 3561, 2003, section 10.
///
/// Formulae, numbered for the comments of this protocol (the numbers are not those of the RFC):
///
///   (R1) NET_TRAVERSAL_TIME  = 2 NODE_TRAVERSAL_TIME NET_DIAMETER                     section 10
///   (R2) PATH_DISCOVERY_TIME = 2 NET_TRAVERSAL_TIME                                   section 10
///   (R3) MY_ROUTE_TIMEOUT    = 2 ACTIVE_ROUTE_TIMEOUT                                 section 10
///   (R4) NEXT_HOP_WAIT       = NODE_TRAVERSAL_TIME + 10 ms                            section 10
///   (R5) BLACKLIST_TIMEOUT   = RREQ_RETRIES NET_TRAVERSAL_TIME                        section 10
///   (R6) MAX_REPAIR_TTL      = 0.3 NET_DIAMETER                                       section 10
///   (R7) DELETE_PERIOD       = K max(ACTIVE_ROUTE_TIMEOUT, HELLO_INTERVAL), K = 5     section 10
///   (R8) RING_TRAVERSAL_TIME = 2 NODE_TRAVERSAL_TIME (TTL_VALUE + TIMEOUT_BUFFER)     section 10
/// (R9) lifetime of a reverse route: at least
///        2 NET_TRAVERSAL_TIME - 2 HopCount NODE_TRAVERSAL_TIME                        section 6.5
struct AodvConfig {
  Duration active_route_timeout = std::chrono::seconds{3};  ///< > 0.
  int allowed_hello_loss = 2;                               ///< >= 1.
  Duration hello_interval = std::chrono::seconds{1};        ///< > 0.
  int local_add_ttl = 2;                                    ///< >= 0.
  int net_diameter = 35;                                    ///< 1..255, hops.
  /// > 0. Conservative estimate of the time of a hop: queueing, processing, medium access.
  Duration node_traversal_time = std::chrono::milliseconds{40};
  int rerr_ratelimit = 10;  ///< >= 1, per second.
  int rreq_ratelimit = 10;  ///< >= 1, per second.
  int rreq_retries = 2;     ///< >= 0.
  int timeout_buffer = 2;   ///< >= 0.
  int ttl_start = 1;        ///< >= 1.
  int ttl_increment = 2;    ///< >= 1.
  int ttl_threshold = 7;    ///< >= 1.

  // Choices that the RFC leaves to the node.
  bool hello = true;              ///< Section 6.9; false: only the link reports lost neighbours.
  bool destination_only = false;  ///< Flag 'D' of a RREQ, section 5.1.
  bool gratuitous_reply = true;   ///< Flag 'G' of a RREQ, section 6.6.3.
  bool local_repair = false;      ///< Section 6.12.
  bool wait_after_start = false;  ///< Section 6.13: DELETE_PERIOD without answers after a start.

  /// NET_TRAVERSAL_TIME (R1).
  Duration net_traversal_time() const { return 2 * node_traversal_time * net_diameter; }
  /// PATH_DISCOVERY_TIME (R2).
  Duration path_discovery_time() const { return 2 * net_traversal_time(); }
  /// MY_ROUTE_TIMEOUT (R3).
  Duration my_route_timeout() const { return 2 * active_route_timeout; }
  /// NEXT_HOP_WAIT (R4).
  Duration next_hop_wait() const { return node_traversal_time + std::chrono::milliseconds{10}; }
  /// BLACKLIST_TIMEOUT (R5), at least one NET_TRAVERSAL_TIME.
  Duration blacklist_timeout() const { return std::max(1, rreq_retries) * net_traversal_time(); }
  /// MAX_REPAIR_TTL (R6), rounded down, at least 1.
  int max_repair_ttl() const { return std::max(1, net_diameter * 3 / 10); }
  /// DELETE_PERIOD (R7) with the K that the RFC recommends.
  Duration delete_period() const { return 5 * std::max(active_route_timeout, hello_interval); }
  /// RING_TRAVERSAL_TIME (R8) of a RREQ with this TTL.
  Duration ring_traversal_time(int ttl) const {
    return 2 * node_traversal_time * (ttl + timeout_buffer);
  }
};

/// Keys of `algorithm: aodv` by the names of RFC 3561, section 10; and those of what it leaves to
/// the node.
template <class Fields>
void keys_of(Fields& io, AodvConfig& c) {
  io.duration(
      {"active_route_timeout", "A route that is not used for so long is no longer valid.", "3 s"},
      {1e-3, 3600}, c.active_route_timeout);
  io.count({"allowed_hello_loss", "Hellos in a row that a neighbour may miss.", "2"}, 1, 100,
           c.allowed_hello_loss);
  io.duration({"hello_interval", "Between two hellos of a node on an active route.", "1 s"},
              {1e-3, 3600}, c.hello_interval);
  io.count({"local_add_ttl", "Hops that a local repair searches beyond the last known ones.", "2"},
           0, 255, c.local_add_ttl);
  io.count({"net_diameter", "Most hops between any two nodes.", "35"}, 1, 255, c.net_diameter);
  io.duration({"node_traversal_time", "Conservative estimate of the time of one hop.", "40 ms"},
              {1e-6, 60}, c.node_traversal_time);
  io.count({"rerr_ratelimit", "Route errors that a node sends in a second at most.", "10"}, 1,
           10000, c.rerr_ratelimit);
  io.count({"rreq_ratelimit", "Route requests that a node originates in a second at most.", "10"},
           1, 10000, c.rreq_ratelimit);
  io.count({"rreq_retries", "Requests over the whole network after the first one.", "2"}, 0, 100,
           c.rreq_retries);
  io.count({"timeout_buffer", "Hops added to a ring when waiting for its answer.", "2"}, 0, 255,
           c.timeout_buffer);
  io.count({"ttl_start", "Hops of the first ring of a search.", "1"}, 1, 255, c.ttl_start);
  io.count({"ttl_increment", "Hops by which the next ring is wider.", "2"}, 1, 255,
           c.ttl_increment);
  io.count({"ttl_threshold", "Widest ring before the whole network is searched.", "7"}, 1, 255,
           c.ttl_threshold);
  io.flag({"hello",
           "Whether nodes on active routes send hellos and miss those of others; else only the "
           "link tells that a neighbour is lost.",
           "false"},
          c.hello);
  io.flag({"destination_only", "Whether only the destination may answer a request.", "true"},
          c.destination_only);
  io.flag({"gratuitous_reply",
           "Whether a node that answers a request for another also tells that one the way back.",
           "false"},
          c.gratuitous_reply);
  io.flag({"local_repair",
           "Whether a node on the way looks for another route itself when its next hop is lost.",
           "true"},
          c.local_repair);
  io.flag({"wait_after_start",
           "Whether a node that starts neither searches nor answers nor relays searches until what "
           "others know of its earlier life is forgotten: five times active_route_timeout, or "
           "hello_interval if that is longer.",
           "true"},
          c.wait_after_start);
}

}  // namespace hal::node::routing
