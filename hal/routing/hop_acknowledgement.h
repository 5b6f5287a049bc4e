#pragma once

#include <deque>
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
///   transmit --> waiting --fewer than kWindow in flight--> in flight --hop ack--> kDelivered
///      |                                                    | ^
///      +--buffer_limit wait--> kQueueFull       ack_timeout | | again, after twice the time
///                                                           v |
///                                            attempts left? --no--> kRetryLimit
///
/// A neighbour that is given up takes all frames for it along. The window keeps a burst from
/// flooding a queue below that overflows without a word.
///
/// An acknowledgement of its own, not overhearing the next hop pass the frame on: a socket gets
/// unicast datagrams of others only with special rights, the last hop passes nothing on, and a next
/// hop that first has to look for a route would pass for dead. (DSR knows both: RFC 4728, 8.3.2 and
/// 8.3.3.) The default timeouts add up to 750 ms.
class HopAcknowledgement final : public Link {
 public:
  using Report = std::function<void(const Transmission&)>;
  static constexpr std::size_t kWindow = 4;  ///< Frames in flight to one neighbour.

  /// @param report  called once for every transmit(), never from within it.
  HopAcknowledgement(const RoutingConfig& config, Link& link, Timers& timers, Report report);

  LinkCapabilities capabilities() const override;
  /// A broadcast is sent once and counts as delivered. @pre unicast: the frame is a packet.
  void transmit(AgentId next_hop, Bytes packet, LinkTag tag) override;
  Duration expected_delay() const override { return link_.expected_delay(); }
  double transmit_energy(std::size_t bytes) const override { return link_.transmit_energy(bytes); }

  /// Notes a frame that came in. @return whether it is the first copy.
  bool on_numbered(AgentId from, HopNumber number);
  void acknowledge(AgentId neighbour, HopNumber number);
  /// Acknowledgements that nobody waits for (copies, late ones, forged ones) have no effect.
  void on_ack(AgentId from, HopNumber number);

  /// Reports all frames for a neighbour as failed.
  void give_up(AgentId neighbour);

 private:
  struct Waiting {
    Bytes packet;
    LinkTag tag = 0;
  };
  struct InFlight {
    Bytes frame;
    LinkTag tag = 0;
    int attempts = 0;
    Duration timeout{};
    OwnTimers::Handle timer = 0;
  };
  /// What is on its way to one neighbour.
  struct Lane {
    std::deque<Waiting> waiting;
    std::map<HopNumber, InFlight> in_flight;
  };

  void report_soon(LinkTag tag, Verdict verdict);
  void fill(AgentId next_hop);
  void attempt(AgentId next_hop, HopNumber number, InFlight& sent);
  void on_timeout(AgentId next_hop, HopNumber number);

  const RoutingConfig config_;
  Link& link_;
  OwnTimers timers_;
  Report report_;
  HopNumber last_number_;
  std::map<AgentId, Lane> lanes_;  ///< None is empty.
  Memory<std::pair<AgentId, HopNumber>, Seen> received_;
};

}  // namespace hal::routing
