#pragma once

#include <cstdint>

#include "hal/types/time.h"

namespace hal::routing {

using namespace std::chrono_literals;

/// Parameters of the ant routing. Defaults: the replica of the paper's case study.
struct RoutingConfig {
  double beta = 2;  ///< Exponent of the forwarding probability, >= 1.
  double direct_weight =
      1e6;  ///< > 0: r of a neighbour that is the destination; else r = 1 / hops.
  Duration jitter_max = 100ms;  ///< Rebroadcasts wait U(0, jitter_max); >= 0.
  Duration retry_period = 5s;   ///< Between discoveries of one destination; > 0.
  int retries = 3;              ///< Discoveries in all before the route is given up, >= 1.
  double acceptance =
      1.5;  ///< >= 1: later copies of an ant: at most this times the best, in hops …
  bool accept_anywhere = false;     ///< … at every node; else only at the destination.
  int hop_limit = 30;               ///< Of ants, floods and data, 1..255.
  std::uint32_t buffer_limit = 64;  ///< Messages that wait for one route.
  Duration buffer_age = 10s;        ///< A message waits for a route no longer than this; > 0.
};

}  // namespace hal::routing
