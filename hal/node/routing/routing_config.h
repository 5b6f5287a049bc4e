#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "hal/node/routing/algorithm.h"
#include "hal/node/routing/anthocnet_config.h"
#include "hal/node/routing/aodv_config.h"
#include "hal/node/routing/static_config.h"
#include "hal/types/path_metric.h"
#include "hal/types/priority.h"
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
  Algorithm algorithm = Algorithm::kAnts;  ///< kNone: besides, only `priorities` is used.

  // Ants.
  RouteChoice choice{};                                       ///< For classes without their own.
  std::map<std::string, RouteChoice, std::less<>> classes{};  ///< By topic.
  const RouteChoice& choice_of(std::string_view topic) const {
    const auto own = classes.find(topic);
    return own == classes.end() ? choice : own->second;
  }
  Duration jitter_max = 100ms;  ///< Rebroadcasts wait U(0, jitter_max); >= 0.
  Duration retry_period = 5s;   ///< Between discoveries of one destination; > 0.
  /// 0..1: each retry comes earlier by U(0, retry_jitter) times that period. Otherwise nodes whose
  /// first ants collided would always repeat them simultaneously (RFC 5148, 5.1). Earlier, not
  /// later, so that waiting messages still benefit from it.
  double retry_jitter = 0.25;
  int retries = 3;  ///< Discoveries in total before the route is given up, >= 1.
  /// a >= 1 of the acceptance rule h <= a h_best and T <= a T_best, by which later copies of an ant
  /// are accepted, h its hops and T its travel time (G. Di Caro, F. Ducatelle, L. Gambardella,
  /// "AntHocNet: an ant-based hybrid routing algorithm for mobile ad hoc networks", PPSN VIII,
  /// 2004, 3.1).
  double acceptance = 1.5;
  bool accept_anywhere = false;  ///< Accept at every node; false: only at the destination.
  int hop_limit = 30;            ///< Maximum number of hops of ants, floods and data, 1..255.
  /// Maximum number of messages that wait for one route or next hop.
  std::uint32_t buffer_limit = 64;
  Duration buffer_age = 10s;  ///< Longest time for which a message waits for a route; > 0.

  AodvConfig aodv{};
  AntHocNetConfig anthocnet{};
  StaticConfig statics{};

  // Used only over a link without transmit status (hop_acknowledgement.h, hello.h).
  /// Time until a frame is repeated, doubled each time; > 0.
  Duration ack_timeout = 50ms;
  int ack_attempts = 4;           ///< Transmissions before a hop counts as failed, 1..16.
  Duration hello_period = 1s;     ///< Time between two hellos; 1 ms..1 h.
  std::uint32_t hello_limit = 2;  ///< Successive hellos of a neighbour that may be lost, >= 1.

  /// By topic: priority of the messages that an agent sends, whatever its controller says. Also
  /// used with kNone.
  std::map<std::string, Priority, std::less<>> priorities{};
  /// Priority of the protocol's own packets, which carry no message. Routing daemons on Linux mark
  /// theirs CS6, the code point of network control (RFC 4594, 3.2): Priority{6}.
  Priority control_priority{};

  /// Numbers of this node's packets start after this one. Other nodes remember numbers for a
  /// minute, so a node that may restart draws a new value each time, below 2^31; otherwise its
  /// packets would be taken for duplicates. Simulated nodes start at 0.
  std::uint32_t first_sequence = 0;
};

}  // namespace hal::node::routing
