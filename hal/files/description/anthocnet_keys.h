#pragma once

#include "hal/files/description/fields.h"
#include "hal/node/routing/routing_config.h"

namespace hal::files::description {

/// Defaults of AntHocNet that differ from RoutingConfig: a jitter that is small compared with the
/// repair time-out, and the retry period of the port of its ETT version.
inline void anthocnet_defaults(node::routing::RoutingConfig& c) {
  c.jitter_max = std::chrono::milliseconds{10};
  c.retry_period = std::chrono::seconds{2};
}

/// Keys of path setup and pheromone.
inline void ant_path_keys(Fields& io, node::routing::AntHocNetConfig& c) {
  io.number({"beta_reactive",
             "Exponent of pheromone where a reactive or a repair ant picks its next hop.", "1"},
            "1", {0, 100}, c.beta_reactive);
  io.number({"beta_proactive", "Exponent of pheromone where a proactive ant does.", "1"}, "1",
            {0, 100}, c.beta_proactive);
  io.number({"beta_data", "Exponent of pheromone where a message does.", "20"}, "1", {0, 100},
            c.beta_data);
  io.number({"acceptance_same_first_hop",
             "A later copy of an ant is taken if its hops and its time are at most this times the "
             "best so far.",
             "1.5"},
            "1", {1e-3, 100}, c.acceptance);
  io.number(
      {"acceptance_new_first_hop",
       "The same for a copy that left its source over a neighbour that none before did.", "1.5"},
      "1", {1e-3, 100}, c.acceptance_new_first_hop);
  io.count({"copies", "Copies of one ant that a node broadcasts.", "1"}, 1, 1000, c.copies);
  io.number({"mac_weight", "Weight of the past in the running average of the MAC's time.", "0.7"},
            "1", {0, 1}, c.mac_weight);
  io.number({"pheromone_weight", "Weight of the past in the running average of pheromone.", "0.7"},
            "1", {0, 1}, c.pheromone_weight);
  io.duration({"hop_time", "What a hop costs in an idle network.", "3 ms"}, {1e-6, 10}, c.hop_time);
}

/// Keys of sessions: diffusion, proactive ants, repair.
inline void ant_session_keys(Fields& io, node::routing::AntHocNetConfig& c) {
  io.count(
      {"hello_destinations",
       "Destinations whose best pheromone a hello tells; 0: pheromone does not diffuse.", "10"},
      0, 20, c.hello_destinations);
  io.duration({"proactive_period", "Between two proactive ants of a session; 0 s: none.", "2 s"},
              {0, 3600}, c.proactive_period);
  io.number({"proactive_margin",
             "A proactive ant leaves if virtual pheromone is this times the best regular one; 0: "
             "always.",
             "1.1"},
            "1", {0, 1000}, c.proactive_margin);
  io.number({"proactive_broadcast_probability",
             "That a proactive ant is broadcast where it could follow pheromone.", "0.1"},
            "1", {0, 1}, c.proactive_broadcast_probability);
  io.count({"proactive_broadcasts", "Broadcasts of one proactive ant.", "2"}, 0, 255,
           c.proactive_broadcasts);
  io.duration({"session_timeout", "A session ends after so long without a message.", "10 s"},
              {1e-3, 3600}, c.session_timeout);
  io.count({"repair_broadcasts", "Broadcasts of one repair ant; 0: no local repair.", "2"}, 0, 255,
           c.repair_broadcasts);
  io.number({"repair_wait",
             "A repair is waited for this times the delay of the lost path, and jitter_max for "
             "each broadcast.",
             "5"},
            "1", {1e-3, 1e6}, c.repair_wait);
}

/// All keys that only `algorithm: anthocnet` has.
inline void anthocnet_keys(Fields& io, node::routing::AntHocNetConfig& c) {
  ant_path_keys(io, c);
  ant_session_keys(io, c);
}

}  // namespace hal::files::description
