#pragma once

#include <array>
#include <deque>
#include <functional>
#include <map>

#include "hal/node/routing/frame.h"
#include "hal/node/routing/memory.h"
#include "hal/node/routing/own_timers.h"
#include "hal/node/routing/ports.h"
#include "hal/node/routing/routing_config.h"

namespace hal::node::routing {

/// Adds transmit status to a link without it: numbers unicast frames, repeats them until the next
/// hop's router acknowledges them, and gives up as a MAC does, with kRetryLimit. The receiver drops
/// repeated frames, but acknowledges them again.
///
///   transmit --> waiting --fewer than kWindow in flight--> in flight --hop ack--> kDelivered
///      |                                                    | ^
///      +--buffer_limit wait--> kQueueFull       ack_timeout | | again, with twice the time-out
///                                                           v |
///                                            attempts left? --no--> kRetryLimit
///
/// When a neighbour is given up, all frames for it fail. The window prevents a burst from
/// overflowing a lower-layer queue that drops frames without notice. As the layer below, it keeps
/// access categories apart: each has its own window and its own limit of waiting frames, and an
/// acknowledgement has the priority of the frame that it acknowledges.
///
/// Acknowledgements are explicit rather than passive (overhearing that the next hop forwards the
/// frame): a socket receives unicast datagrams of others only with special privileges, the last hop
/// does not forward, and a next hop that first has to search for a route would appear dead. (DSR
/// has both: RFC 4728, 8.3.2 and 8.3.3.) The default time-outs add up to 750 ms.
class HopAcknowledgement final : public Link {
 public:
  using Report = std::function<void(const Transmission&)>;
  /// Frames in flight to one neighbour, of one access category.
  static constexpr std::size_t kWindow = 4;

  /// @param report  called once for every transmit(), never from within it.
  HopAcknowledgement(const RoutingConfig& config, Link& link, Timers& timers, Report report);

  LinkCapabilities capabilities() const override;
  /// A broadcast is sent once and counts as delivered. @pre unicast: the frame is a packet.
  void transmit(AgentId next_hop, Bytes packet, const LinkOptions& options) override;
  Duration expected_delay() const override { return link_.expected_delay(); }
  double transmit_energy(std::size_t bytes) const override { return link_.transmit_energy(bytes); }

  /// Notes a received frame. @return whether it is the first copy.
  bool on_numbered(AgentId from, HopNumber number);
  void acknowledge(AgentId neighbour, HopNumber number, Priority priority);
  /// Unexpected acknowledgements (copies, late ones, forged ones) have no effect.
  void on_ack(AgentId from, HopNumber number);

  /// Reports all frames for a neighbour as failed.
  void give_up(AgentId neighbour);

 private:
  struct Waiting {
    Bytes packet;
    LinkOptions options;
  };
  struct InFlight {
    Bytes frame;
    LinkOptions options;
    int attempts = 0;
    Duration timeout{};
    OwnTimers::Handle timer = 0;
  };
  /// Frames for one neighbour.
  struct Lane {
    std::array<std::deque<Waiting>, kAccessCategories> waiting;
    std::map<HopNumber, InFlight> in_flight;

    std::size_t in_flight_of(std::size_t category) const;
  };

  void report_soon(LinkTag tag, Verdict verdict);
  void fill(AgentId next_hop);
  void send_waiting(AgentId next_hop, Lane& lane, std::size_t category);
  void attempt(AgentId next_hop, HopNumber number, InFlight& sent);
  void on_timeout(AgentId next_hop, HopNumber number);

  const RoutingConfig config_;
  Link& link_;
  OwnTimers timers_;
  Report report_;
  HopNumber last_number_;
  std::map<AgentId, Lane> lanes_;  ///< No lane is empty.
  Memory<std::pair<AgentId, HopNumber>, Seen> received_;
};

}  // namespace hal::node::routing
