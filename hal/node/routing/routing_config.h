#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "hal/node/routing/algorithm.h"
#include "hal/node/routing/anthocnet_config.h"
#include "hal/node/routing/aodv_config.h"
#include "hal/types/path_metric.h"
#include "hal/types/time.h"

namespace hal::node::routing {

using namespace std::chrono_literals;

/// How the messages of a class choose among routes: equation 1 of the paper.
struct RouteChoice {
  PathMetric metric{};  ///< r(.)
  double beta = 2;      ///< Exponent of the forwarding probability, >= 1.
  bool operator==(const RouteChoice&) const = default;
};

/// Parameters of the routing protocols. Defaults: the replica of the paper's case study.
struct RoutingConfig {
  Algorithm algorithm = Algorithm::kAnts;  ///< kNone: nothing below counts.

  /// Ants.
  RouteChoice choice{};                                       ///< Of classes without their own.
  std::map<std::string, RouteChoice, std::less<>> classes{};  ///< By topic.
  const RouteChoice& choice_of(std::string_view topic) const {
    const auto own = classes.find(topic);
    return own == classes.end() ? choice : own->second;
  }
  Duration jitter_max = 100ms;  ///< Rebroadcasts wait U(0, jitter_max); >= 0.
  Duration retry_period = 5s;   ///< Between discoveries of one destination; > 0.
  /// 0..1: each retry comes earlier than that by U(0, retry_jitter) of it. Nodes whose first ants
  /// collided would otherwise repeat them together for ever (RFC 5148, 5.1). Earlier, not later, so
  /// that the messages that wait still profit from it.
  double retry_jitter = 0.25;
  int retries = 3;  ///< Discoveries in all before the route is given up, >= 1.
  /// >= 1: later copies of an ant: at most this times the best, in hops …
  double acceptance = 1.5;
  bool accept_anywhere = false;     ///< … at every node; else only at the destination.
  int hop_limit = 30;               ///< Of ants, floods and data, 1..255.
  std::uint32_t buffer_limit = 64;  ///< Messages that wait for one route or next hop.
  Duration buffer_age = 10s;        ///< A message waits for a route no longer than this; > 0.

  AodvConfig aodv{};
  AntHocNetConfig anthocnet{};

  /// Over a link without transmit status only (hop_acknowledgement.h, hello.h).
  Duration ack_timeout = 50ms;    ///< Until a frame is repeated, doubled each time; > 0.
  int ack_attempts = 4;           ///< Transmissions before a hop counts as failed, 1..16.
  Duration hello_period = 1s;     ///< Between two hellos; 1 ms..1 h.
  std::uint32_t hello_limit = 2;  ///< Hellos in a row that a neighbour may miss, >= 1.

  /// Numbers of this node's packets start after this one. Others remember numbers for a minute: a
  /// node that may restart draws it anew each time, below 2^31, or they take its packets for
  /// copies. Simulated nodes start at 0.
  std::uint32_t first_sequence = 0;
};

}  // namespace hal::node::routing
