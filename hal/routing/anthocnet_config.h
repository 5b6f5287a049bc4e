#pragma once

#include "hal/types/time.h"

namespace hal::routing {

/// Parameters that only AntHocNet has. What it shares with the other algorithms (jitter_max,
/// retry_period, retries, hop_limit, buffers, hellos, hop acknowledgements) is in RoutingConfig.
///
/// Sources: [PPSN] G. Di Caro, F. Ducatelle, L. Gambardella, "AntHocNet: an ant-based hybrid
/// routing algorithm for mobile ad hoc networks", PPSN VIII, 2004; [ETT] the same, "AntHocNet: an
/// adaptive nature-inspired algorithm for routing in mobile ad hoc networks", European Transactions
/// on Telecommunications 16(5), 2005; [thesis] F. Ducatelle, "Adaptive routing in ad hoc wireless
/// multi-hop networks", Universita della Svizzera italiana, 2007. Where none is named the value is
/// this project's.
struct AntHocNetConfig {
  double beta_reactive = 1;   ///< 0..100: exponent of a reactive or repair ant's choice [PPSN].
  double beta_proactive = 1;  ///< 0..100: of a proactive ant's [PPSN].
  double beta_data = 2;       ///< 0..100: of a message's [PPSN]; 20 in [thesis].
  /// > 0: a later copy of an ant is taken if its hops and its time are at most this times the best
  /// so far [ETT]; 1.5 in [PPSN].
  double acceptance = 0.9;
  /// > 0: the same for a copy whose first hop no copy that was taken has [ETT].
  double acceptance_new_first_hop = 2;
  /// >= 1: copies of one ant that a node broadcasts. Without a bound multipath set-up floods a
  /// dense network with copies.
  int copies = 2;
  double mac_weight = 0.7;        ///< alpha, 0..1: weight of the past in the MAC time [PPSN].
  double pheromone_weight = 0.7;  ///< gamma, 0..1: weight of the past in pheromone [PPSN].
  Duration hop_time = std::chrono::milliseconds{3};  ///< T_hop, > 0: of an idle hop [thesis].
  int hello_destinations = 10;  ///< 0..20: that a hello names; 0: no diffusion of pheromone [ETT].
  /// Between two proactive ants of a session [thesis]; 0: none.
  Duration proactive_period = std::chrono::seconds{2};
  /// >= 0: a proactive ant leaves only if the best virtual pheromone is at least this times the
  /// best regular one [thesis]; 0: always.
  double proactive_margin = 1.1;
  double proactive_broadcast_probability = 0.1;  ///< 0..1: at each node on its way [ETT].
  int proactive_broadcasts = 2;                  ///< >= 0: of one proactive ant in all [PPSN].
  /// A session runs until its source has sent nothing for so long; > 0.
  Duration session_timeout = std::chrono::seconds{10};
  int repair_broadcasts = 2;  ///< >= 0: of one repair ant in all [PPSN]; 0: no repair.
  /// > 0: a repair is waited for this times the delay of the path that was lost [PPSN], and
  /// jitter_max for each broadcast on top.
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

}  // namespace hal::routing
