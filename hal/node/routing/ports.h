#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/node/routing/protocol_event.h"
#include "hal/types/agent_id.h"
#include "hal/types/message.h"
#include "hal/types/random.h"
#include "hal/types/route.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"

namespace hal::node::routing {

/// What a link can tell about its frames. Routing also works over a link that has neither.
struct LinkCapabilities {
  /// Calls Router::on_transmitted for every frame. Without it the router finds out by itself
  /// whether a hop works: hop acknowledgements and hellos (RoutingConfig).
  bool tx_status = false;
  /// Gives Reception::rssi_dbm and snr_db. Without it Neighbour::rssi_dbm and
  /// PathStatistics::min_snr_db are 0 and mean nothing.
  bool rssi = false;
};

/// How a frame came in.
struct Reception {
  AgentId from;         ///< The neighbour that transmitted it; never the node itself.
  double rssi_dbm = 0;  ///< 0 without LinkCapabilities::rssi …
  double snr_db = 0;    ///< … and so is this.
};

/// Names a frame handed to the link in its on_transmitted.
using LinkTag = std::uint64_t;

/// What happened to a frame, over a link with transmit status: kDelivered (acknowledged; a
/// broadcast: transmitted), kRetryLimit, kQueueFull, kRadioOff.
struct Transmission {
  LinkTag tag = 0;
  Verdict verdict = Verdict::kDelivered;
};

/// One hop. The simulator's MAC, or a UDP socket.
class Link {
 public:
  virtual ~Link() = default;
  /// The same from the router's construction on.
  virtual LinkCapabilities capabilities() const = 0;

  /// Queues a frame for one neighbour, or for all of them (kEveryone). Never calls back before it
  /// returns.
  virtual void transmit(AgentId next_hop, Bytes frame, LinkTag tag) = 0;

  /// Time the link needs for a frame queued now, for the delay statistics; and the energy [J].
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
  virtual void cancel(Handle handle) = 0;  ///< Of a timer that has run: no effect.
};

/// The application above: the agent.
class Application {
 public:
  virtual ~Application() = default;
  /// A message has arrived. @param transmissions  on its way, the last hop included.
  virtual void on_message(Message message, int transmissions) = 0;
  /// Exactly once per message this node sent.
  virtual void on_fate(MessageId id, Fate fate) = 0;
};

/// Told of the observable events of a router, for records, fingerprints and the controllers'
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
  /// A message ended here, at a node on its way or at its end. kDelivered: at its destination;
  /// for a flood, once per node that it reached. `sent_by` and `id` name the message. Of a message
  /// with copies on several ways, kDelivered wins over the end of another copy.
  virtual void on_message_end(AgentId sent_by, MessageId id, std::string_view topic,
                              Verdict verdict) {
    (void)sent_by, (void)id, (void)topic, (void)verdict;
  }
  /// The protocol did something that is counted.
  virtual void on_protocol_event(ProtocolEvent event) { (void)event; }
};

/// The surroundings of one router; all outlive it.
struct RouterPorts {
  Link& link;
  Timers& timers;
  Application& application;
  RoutingObserver& observer;
};

/// Random streams of one router. Repeated searches have a stream of their own, so that they do not
/// change the numbers of the rest.
struct RouterStreams {
  RandomStream random;   ///< "<agent>/routing": jitter of relays and hellos, choice of next hops.
  RandomStream retries;  ///< "<agent>/routing/retries": jitter of repeated searches.
  RouterStreams(std::uint64_t run_seed, const std::string& agent)
      : random(run_seed, agent + "/routing"), retries(run_seed, agent + "/routing/retries") {}
};

}  // namespace hal::node::routing
