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

/// The parameters of RFC 3561, section 10, by their names there.
template <class Fields>
void aodv_parameter_keys(Fields& io, AodvConfig& c) {
  io.duration(
      {"active_route_timeout", "Time without use after which a route becomes invalid.", "3 s"},
      {1e-3, 3600}, c.active_route_timeout);
  io.count({"allowed_hello_loss",
            "Consecutive hello messages of a neighbour that may be lost before the neighbour "
            "itself counts as lost.",
            "2"},
           1, 100, c.allowed_hello_loss);
  io.duration(
      {"hello_interval", "Time between two hello messages of a node on an active route.", "1 s"},
      {1e-3, 3600}, c.hello_interval);
  io.count({"local_add_ttl", "Hops that are added to the search radius of a local repair.", "2"}, 0,
           255, c.local_add_ttl);
  io.count({"net_diameter", "Largest number of hops between any two nodes.", "35"}, 1, 255,
           c.net_diameter);
  io.duration(
      {"node_traversal_time", "Conservative estimate of the time that a hop takes.", "40 ms"},
      {1e-6, 60}, c.node_traversal_time);
  io.count({"rerr_ratelimit", "Largest number of route errors (RERR) that a node sends per second.",
            "10"},
           1, 10000, c.rerr_ratelimit);
  io.count({"rreq_ratelimit",
            "Largest number of route requests (RREQ) that a node originates per second.", "10"},
           1, 10000, c.rreq_ratelimit);
  io.count(
      {"rreq_retries", "Number of times that a request over the whole network is repeated.", "2"},
      0, 100, c.rreq_retries);
  io.count(
      {"timeout_buffer",
       "Hops that are added to the search radius when computing the time to wait for an answer.",
       "2"},
      0, 255, c.timeout_buffer);
  io.count({"ttl_start", "Radius of the first expanding ring search, in hops.", "1"}, 1, 255,
           c.ttl_start);
  io.count(
      {"ttl_increment", "Increase of the radius from one ring search to the next, in hops.", "2"},
      1, 255, c.ttl_increment);
  io.count(
      {"ttl_threshold",
       "Radius of the largest ring search, in hops; the next one covers the whole network.", "7"},
      1, 255, c.ttl_threshold);
}

/// What the RFC leaves to the node.
template <class Fields>
void aodv_option_keys(Fields& io, AodvConfig& c) {
  io.flag({"hello",
           "Whether nodes on active routes send hello messages and monitor those of others; if "
           "not, only the link reports that a neighbour is lost.",
           "false"},
          c.hello);
  io.flag({"destination_only", "Whether only the destination may answer a route request.", "true"},
          c.destination_only);
  io.flag({"gratuitous_reply",
           "Whether a node that answers a request on behalf of the destination also sends the "
           "destination a route back to the origin.",
           "false"},
          c.gratuitous_reply);
  io.flag(
      {"local_repair",
       "Whether an intermediate node that loses its next hop searches for another route itself.",
       "true"},
      c.local_repair);
  io.flag({"wait_after_start",
           "Whether a node that starts waits before it searches, answers or relays searches, until "
           "others have forgotten its state before the restart: five times active_route_timeout, "
           "or hello_interval if that is longer.",
           "true"},
          c.wait_after_start);
}

/// Keys of `algorithm: aodv`.
template <class Fields>
void keys_of(Fields& io, AodvConfig& c) {
  aodv_parameter_keys(io, c);
  aodv_option_keys(io, c);
}

}  // namespace hal::node::routing
