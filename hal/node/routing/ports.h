#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/node/routing/protocol_event.h"
#include "hal/types/agent_id.h"
#include "hal/types/message.h"
#include "hal/types/priority.h"
#include "hal/types/random.h"
#include "hal/types/route.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"

namespace hal::node::routing {

/// What a link can report about its frames. Routing also works over a link that reports neither.
struct LinkCapabilities {
  /// Calls Router::on_transmitted for every frame. Without it the router determines by itself
  /// whether a hop works: by hop acknowledgements and hellos (RoutingConfig).
  bool tx_status = false;
  /// Provides Reception::rssi_dbm and snr_db. Without it Neighbour::rssi_dbm and
  /// PathStatistics::min_snr_db are 0 and have no meaning.
  bool rssi = false;
};

/// Properties of a received frame.
struct Reception {
  AgentId from;         ///< The neighbour that transmitted it; never the node itself.
  double rssi_dbm = 0;  ///< 0 without LinkCapabilities::rssi.
  double snr_db = 0;    ///< 0 without LinkCapabilities::rssi.
};

/// Identifies a frame passed to the link in its on_transmitted.
using LinkTag = std::uint64_t;

/// The result of a frame, over a link with transmit status: kDelivered (acknowledged; a
/// broadcast: transmitted), kRetryLimit, kQueueFull, kRadioOff.
struct Transmission {
  LinkTag tag = 0;
  Verdict verdict = Verdict::kDelivered;
};

/// How a frame is passed to the link. A tag alone is enough.
struct LinkOptions {
  LinkTag tag = 0;
  /// Frames of a higher access category go first, if the link can tell them apart.
  Priority priority{};

  // NOLINTNEXTLINE(google-explicit-constructor): most frames have no priority
  constexpr LinkOptions(LinkTag of = 0, Priority as = {}) : tag(of), priority(as) {}
};

/// Transmits over one hop: the simulator's MAC, or a UDP socket.
class Link {
 public:
  virtual ~Link() = default;
  /// Constant from the router's construction on.
  virtual LinkCapabilities capabilities() const = 0;

  /// Queues a frame for one neighbour, or for all of them (kEveryone). Never calls back before it
  /// returns.
  virtual void transmit(AgentId next_hop, Bytes frame, const LinkOptions& options) = 0;

  /// Expected time until a frame queued now is transmitted, for the delay statistics; and energy
  /// [J].
  virtual Duration expected_delay() const = 0;
  virtual double transmit_energy(std::size_t bytes) const = 0;
};

/// Calls back at a later time of the node's clock.
class Timers {
 public:
  virtual ~Timers() = default;
  using Handle = std::uint64_t;  ///< Never 0.
  virtual Time now() const = 0;
  virtual Handle schedule(Time at, std::function<void()> handler) = 0;
  virtual void cancel(Handle handle) = 0;  ///< No effect on a timer that has fired.
};

/// The application above: the agent.
class Application {
 public:
  virtual ~Application() = default;
  /// A message has arrived. @param transmissions  number of hops so far, including the last one.
  virtual void on_message(Message message, int transmissions) = 0;
  /// Called exactly once per message that this node sent.
  virtual void on_fate(MessageId id, Fate fate) = 0;
};

/// Receives the observable events of a router, for records, fingerprints and the controllers'
/// Network.
class RoutingObserver {
 public:
  virtual ~RoutingObserver() = default;
  virtual void on_route_change(const RouteChange& change) { (void)change; }
  virtual void on_neighbour(const Neighbour& neighbour) { (void)neighbour; }
  virtual void on_neighbour_lost(AgentId neighbour) { (void)neighbour; }
  /// A discovery ended: found, or given up after the last retry. `took` includes the retries.
  virtual void on_discovery(std::string_view topic, AgentId destination, Duration took,
                            bool found) {
    (void)topic, (void)destination, (void)took, (void)found;
  }
  /// A message ended at this node, its destination or a relay. kDelivered: at its destination; for
  /// a flood, once per node that it reached. `sent_by` and `id` identify the message. If a message
  /// has copies on several paths, kDelivered takes precedence over the end of another copy.
  virtual void on_message_end(AgentId sent_by, MessageId id, std::string_view topic,
                              Verdict verdict) {
    (void)sent_by, (void)id, (void)topic, (void)verdict;
  }
  /// The protocol reports an event that is counted.
  virtual void on_protocol_event(ProtocolEvent event) { (void)event; }
};

/// The surroundings of one router; all outlive it.
struct RouterPorts {
  Link& link;
  Timers& timers;
  Application& application;
  RoutingObserver& observer;
};

/// Random streams of one router. Repeated searches have their own stream, so that they do not
/// change the numbers of the rest.
struct RouterStreams {
  RandomStream random;   ///< "<agent>/routing": jitter of relays and hellos, choice of next hops.
  RandomStream retries;  ///< "<agent>/routing/retries": jitter of repeated searches.
  RouterStreams(std::uint64_t run_seed, const std::string& agent)
      : random(run_seed, agent + "/routing"), retries(run_seed, agent + "/routing/retries") {}
};

}  // namespace hal::node::routing
