#pragma once

#include "hal/files/description/fields.h"
#include "hal/node/routing/aodv_config.h"

namespace hal::files::description {

/// Default maximum jitter of a rebroadcast: well below NODE_TRAVERSAL_TIME. The RFC states none.
inline constexpr Duration kAodvJitter = std::chrono::milliseconds{10};

/// Keys of `algorithm: aodv` with the names of RFC 3561, section 10, and keys for the choices that
/// the RFC leaves to the node.
inline void aodv_keys(Fields& io, node::routing::AodvConfig& c) {
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

}  // namespace hal::files::description
