#pragma once

#include <functional>
#include <map>

#include "hal/routing/frame.h"
#include "hal/routing/memory.h"
#include "hal/routing/own_timers.h"
#include "hal/routing/ports.h"
#include "hal/routing/routing_config.h"

namespace hal::routing {

/// Makes a link with transmit status out of one that has none: numbers unicast frames, repeats them
/// until the next hop's router acknowledges them, and gives up as a MAC does, with kRetryLimit.
/// Repeated frames are dropped by the receiver, but acknowledged again.
///
///   transmit --> sent --hop ack--------------------------> kDelivered
///                 | ^
///   ack_timeout   | | again, after twice the time
///                 v |
///               attempts left? --no--> kRetryLimit
///
/// An acknowledgement of its own, not overhearing the next hop pass the frame on: a socket gets
/// unicast datagrams of others only with special rights, the last hop passes nothing on, and a next
/// hop that first has to look for a route would pass for dead. (DSR knows both: RFC 4728, 8.3.2 and
/// 8.3.3.) The default timeouts add up to 750 ms.
class HopAcknowledgement final : public Link {
 public:
  using Report = std::function<void(const Transmission&)>;

  /// @param report  called once for every transmit(), never from within it.
  HopAcknowledgement(const RoutingConfig& config, Link& link, Timers& timers, Report report);

  LinkCapabilities capabilities() const override;
  /// A broadcast is sent once and counts as delivered. @pre unicast: the frame is a packet.
  void transmit(AgentId next_hop, Bytes packet, LinkTag tag) override;
  Duration expected_delay() const override { return link_.expected_delay(); }
  double transmit_energy(std::size_t bytes) const override { return link_.transmit_energy(bytes); }

  /// Acknowledges a frame that came in. @return whether it is the first copy.
  bool on_numbered(AgentId from, HopNumber number);
  /// Acknowledgements that nobody waits for (copies, late ones, forged ones) have no effect.
  void on_ack(AgentId from, HopNumber number);

 private:
  struct Pending {
    AgentId next_hop;
    Bytes frame;
    LinkTag tag = 0;
    int attempts = 0;
    Duration timeout{};
    OwnTimers::Handle timer = 0;
  };

  void attempt(HopNumber number, Pending& pending);
  void on_timeout(HopNumber number);

  const RoutingConfig config_;
  Link& link_;
  OwnTimers timers_;
  Report report_;
  HopNumber last_number_;
  std::map<HopNumber, Pending> pending_;
  Memory<std::pair<AgentId, HopNumber>, Seen> received_;
};

}  // namespace hal::routing
