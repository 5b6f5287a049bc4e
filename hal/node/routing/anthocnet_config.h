#pragma once

#include "hal/types/time.h"

namespace hal::node::routing {

/// Parameters that only AntHocNet has. The parameters that it shares with other algorithms
/// (jitter_max, retry_period, retries, hop_limit, buffers, hellos, hop acknowledgements) are in
/// RoutingConfig.
///
/// Sources: [PPSN] G. Di Caro, F. Ducatelle, L. Gambardella, "AntHocNet: an ant-based hybrid
/// routing algorithm for mobile ad hoc networks", PPSN VIII, 2004; [ETT] the same, "AntHocNet: an
/// adaptive nature-inspired algorithm for routing in mobile ad hoc networks", European Transactions
/// on Telecommunications 16(5), 2005; [thesis] F. Ducatelle, "Adaptive routing in ad hoc wireless
/// multi-hop networks", Universita della Svizzera italiana, 2007. A value without a source is this
/// project's.
///
/// Formulae, numbered for the comments of this protocol (the numbers are not those of the papers):
///
///   (A1) T_mac := alpha T_mac + (1 - alpha) t              [PPSN], 3.1; anthocnet_mac_time
///   (A2) T_i = (Q + 1) T_mac                               [PPSN], 3.1; anthocnet_mac_time
///   (A3) tau = ((T + h T_hop) / 2)^-1, T the sum of T_i    [PPSN], 3.1; anthocnet_node
///   (A4) T_nd := gamma T_nd + (1 - gamma) tau              [PPSN]; anthocnet_pheromone
///   (A5) P_nd = T_nd^beta / sum over j of T_jd^beta        [PPSN], 3.2; anthocnet_pheromone
///   (A6) v' = (1 / v + (T_i + T_hop) / 2)^-1               [ETT], 3.4; anthocnet_diffusion
///   (A7) h <= a h_best and T <= a T_best                   [ETT], 3.2; anthocnet_ants
///
/// with t the time of one successful transmission, Q the number of frames that wait, T_i the
/// expected time of a hop, T (the sum of T_i) and h the time and the hops of a path, T_nd the
/// pheromone towards d via n, v the pheromone that a neighbour reports. Times in s, pheromone in
/// 1/s.
struct AntHocNetConfig {
  double beta_reactive = 1;   ///< 0..100: beta of (A5) for reactive and repair ants [PPSN].
  double beta_proactive = 1;  ///< 0..100: beta of (A5) for proactive ants [PPSN].
  double beta_data = 2;       ///< 0..100: beta of (A5) for messages [PPSN]; 20 in [thesis].
  /// > 0: a of (A7), by which a node accepts further copies of an ant [ETT]; 1.5 in [PPSN].
  double acceptance = 0.9;
  /// > 0: a of (A7) for a copy with a first hop that no accepted copy had [ETT].
  double acceptance_new_first_hop = 2;
  /// >= 1: maximum number of copies of one ant that a node broadcasts. Without a limit, multipath
  /// setup floods a dense network with copies.
  int copies = 2;
  double mac_weight = 0.7;                           ///< 0..1: alpha of (A1) [PPSN].
  double pheromone_weight = 0.7;                     ///< 0..1: gamma of (A4) [PPSN].
  Duration hop_time = std::chrono::milliseconds{3};  ///< > 0: T_hop, time of an idle hop [thesis].
  /// 0..20: maximum number of targets in a hello; 0: no diffusion [ETT].
  int hello_destinations = 10;
  /// Period of proactive ants in a session [thesis]; 0: no proactive ants.
  Duration proactive_period = std::chrono::seconds{2};
  /// >= 0: a proactive ant is sent only if the best virtual pheromone is at least this times the
  /// best regular one [thesis]; 0: always.
  double proactive_margin = 1.1;
  /// 0..1: probability that a node on the ant's path broadcasts it [ETT].
  double proactive_broadcast_probability = 0.1;
  int proactive_broadcasts = 2;  ///< >= 0: of one proactive ant in total [PPSN].
  /// > 0: a session ends when its source has sent no message for this time.
  Duration session_timeout = std::chrono::seconds{10};
  int repair_broadcasts = 2;  ///< >= 0: of one repair ant in total [PPSN]; 0: no repair.
  /// > 0: a repair is given up after this factor times the delay of the lost path [PPSN], plus
  /// jitter_max for each broadcast.
  double repair_wait = 5;
};

/// Whether every value is in the range its comment gives.
inline bool is_valid(const AntHocNetConfig& c) {
  const auto is_share = [](double value) { return value >= 0 && value <= 1; };
  const auto is_beta = [](double value) { return value >= 0 && value <= 100; };
  return is_beta(c.beta_reactive) && is_beta(c.beta_proactive) && is_beta(c.beta_data) &&
         c.acceptance > 0 && c.acceptance_new_first_hop > 0 && c.copies >= 1 &&
         is_share(c.mac_weight) && is_share(c.pheromone_weight) && c.hop_time > Duration::zero() &&
         c.hello_destinations >= 0 && c.hello_destinations <= 20 &&
         c.proactive_period >= Duration::zero() && c.proactive_margin >= 0 &&
         is_share(c.proactive_broadcast_probability) && c.proactive_broadcasts >= 0 &&
         c.proactive_broadcasts <= 255 && c.session_timeout > Duration::zero() &&
         c.repair_broadcasts >= 0 && c.repair_broadcasts <= 255 && c.repair_wait > 0;
}

/// Keys of path setup and pheromone.
template <class Fields>
void ant_path_keys(Fields& io, AntHocNetConfig& c) {
  io.number({"beta_reactive",
             "Exponent of pheromone when a reactive or repair ant chooses its next hop.", "1"},
            "1", {0, 100}, c.beta_reactive);
  io.number(
      {"beta_proactive", "Exponent of pheromone when a proactive ant chooses its next hop.", "1"},
      "1", {0, 100}, c.beta_proactive);
  io.number({"beta_data", "Exponent of pheromone when a message chooses its next hop.", "20"}, "1",
            {0, 100}, c.beta_data);
  io.number({"acceptance_same_first_hop",
             "A node accepts a later copy of an ant only if its hops and its travel time are at "
             "most this factor times the best so far.",
             "1.5"},
            "1", {1e-3, 100}, c.acceptance);
  io.number({"acceptance_new_first_hop",
             "The same factor for a copy whose first hop is one that no accepted copy had.", "1.5"},
            "1", {1e-3, 100}, c.acceptance_new_first_hop);
  io.count({"copies", "Largest number of copies of one ant that a node broadcasts.", "1"}, 1, 1000,
           c.copies);
  io.number(
      {"mac_weight",
       "Weight of the past in the running mean of the time that the MAC needs for a frame.", "0.7"},
      "1", {0, 1}, c.mac_weight);
  io.number({"pheromone_weight", "Weight of the past in the running mean of pheromone.", "0.7"},
            "1", {0, 1}, c.pheromone_weight);
  io.duration({"hop_time", "Time of a hop in an idle network.", "3 ms"}, {1e-6, 10}, c.hop_time);
}

/// Keys of what goes on while a session runs.
template <class Fields>
void ant_session_keys(Fields& io, AntHocNetConfig& c) {
  io.count({"hello_destinations",
            "Largest number of destinations whose best pheromone a hello message contains; 0: "
            "pheromone does not diffuse.",
            "10"},
           0, 20, c.hello_destinations);
  io.duration({"proactive_period",
               "Time between two proactive ants of a session; 0 s: no proactive ants.", "2 s"},
              {0, 3600}, c.proactive_period);
  io.number({"proactive_margin",
             "A proactive ant is sent only if the best virtual pheromone is at least this factor "
             "times the best regular one; 0: always.",
             "1.1"},
            "1", {0, 1000}, c.proactive_margin);
  io.number(
      {"proactive_broadcast_probability",
       "Probability that a node broadcasts a proactive ant although it could follow pheromone.",
       "0.1"},
      "1", {0, 1}, c.proactive_broadcast_probability);
  io.count({"proactive_broadcasts", "Largest number of broadcasts of one proactive ant.", "2"}, 0,
           255, c.proactive_broadcasts);
  io.duration({"session_timeout", "Time without a message after which a session ends.", "10 s"},
              {1e-3, 3600}, c.session_timeout);
  io.count({"repair_broadcasts",
            "Largest number of broadcasts of one repair ant; 0: no local repair.", "2"},
           0, 255, c.repair_broadcasts);
  io.number({"repair_wait",
             "A repair is given up after this factor times the delay of the lost path, plus "
             "jitter_max for each broadcast.",
             "5"},
            "1", {1e-3, 1e6}, c.repair_wait);
}

/// Keys of `algorithm: anthocnet` alone.
template <class Fields>
void keys_of(Fields& io, AntHocNetConfig& c) {
  ant_path_keys(io, c);
  ant_session_keys(io, c);
}

}  // namespace hal::node::routing
