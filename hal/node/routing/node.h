#pragma once

#include <functional>

#include "hal/node/routing/own_timers.h"
#include "hal/node/routing/packet.h"
#include "hal/node/routing/ports.h"
#include "hal/node/routing/routing_config.h"

namespace hal::node::routing {

/// Shared by all parts of one router.
struct Node {
  AgentId self;
  RoutingConfig config;
  RandomStream random;
  RandomStream retry_random;
  RouterPorts ports;
  OwnTimers timers;
  Sequence last_sequence = config.first_sequence;

  Time now() const { return ports.timers.now(); }
  Sequence next_sequence() { return ++last_sequence; }

  void count(ProtocolEvent event) const { ports.observer.on_protocol_event(event); }

  /// Runs the action after a random time of at most jitter_max; at once if that is 0. Without
  /// jitter, the answers of several neighbours to one broadcast would collide.
  void after_jitter(std::function<void()> action);

  /// The path statistics of an ant that was received in a frame of `frame_size` bytes, extended by
  /// the hop back to its transmitter. Radio links are assumed to be symmetric.
  PathStatistics lengthened(const PathStatistics& way, const Reception& hop,
                            std::size_t frame_size) const;
};

/// A received frame.
struct Arrival {
  Reception reception;
  std::size_t size = 0;  ///< Bytes of the frame.
};

}  // namespace hal::node::routing
