#pragma once

#include "hal/node/routing/flooding.h"
#include "hal/node/routing/hop_layer.h"
#include "hal/node/routing/protocol.h"

namespace hal::node::routing {

/// Baseline without routes: every message is flooded, also one to a single node. Each node forwards
/// a message once, after a jitter, until hop_limit is reached; the destination delivers the first
/// copy and forwards none. (C. Ho, K. Obraczka, G. Tsudik, K. Viswanath, "Flooding for Reliable
/// Multicast in Multi-Hop Ad Hoc Networks", 1999: the basic scheme.)
///
/// Broadcasts are not acknowledged: the fate of a message reports only its transmission. A message
/// to one node that is not delivered ends as kExpired after the longest possible duration of its
/// flood. The sender reports this without knowing whether the message was delivered: kDelivered
/// takes precedence (RoutingObserver::on_message_end).
class FloodRouting final : public Protocol, private HopListener {
 public:
  FloodRouting(AgentId self, const RoutingConfig& config, const RouterStreams& streams,
               const RouterPorts& ports);

  void send(const Message& message) override { flooding_.send(message); }
  void invalidate(std::string_view, AgentId) override {}
  std::vector<Route> routes(std::string_view, AgentId) const override { return {}; }
  std::vector<Route> routes() const override { return {}; }
  std::vector<Neighbour> neighbours() const override { return hops_.neighbours(); }
  bool on_frame(const Reception& reception, std::span<const std::uint8_t> bytes) override;
  void on_transmitted(const Transmission& transmission) override;

 private:
  bool on_packet(Packet packet, const Arrival& arrival) override;
  void on_no_answer(AgentId) override {}
  void on_sent(Transit transit, Verdict verdict) override;
  Duration longest_flood();

  HopLayer hops_;
  Flooding flooding_{hops_.node(), hops_.outbox()};
};

}  // namespace hal::node::routing
