#pragma once

#include "hal/node/routing/ants.h"
#include "hal/node/routing/flooding.h"
#include "hal/node/routing/hop_layer.h"
#include "hal/node/routing/protocol.h"

namespace hal::node::routing {

/// Ant routing of one node. Forward ants are flooded to find routes on demand, and backward ants
/// return along their paths. For each message class a node keeps every next hop that leads to a
/// destination, and data packets choose among them at random (Labella, Dietrich, Dressler, "Hybrid
/// simulation of Sensor and Actor Networks with BARAKA", 2009, section 6.1; after Di Caro,
/// Ducatelle, Gambardella, "AntHocNet", 2005).
class AntRouting final : public Protocol, private HopListener {
 public:
  AntRouting(AgentId self, const RoutingConfig& config, const RouterStreams& streams,
             const RouterPorts& ports);

  void send(const Message& message) override;
  void invalidate(std::string_view topic, AgentId destination) override;
  std::vector<Route> routes(std::string_view topic, AgentId destination) const override;
  std::vector<Route> routes() const override { return table_.routes(); }
  std::vector<Neighbour> neighbours() const override { return hops_.neighbours(); }
  bool on_frame(const Reception& reception, std::span<const std::uint8_t> bytes) override;
  void on_transmitted(const Transmission& transmission) override;

 private:
  bool on_packet(Packet packet, const Arrival& arrival) override;
  void on_no_answer(AgentId neighbour) override;
  void on_sent(Transit transit, Verdict verdict) override;

  bool take(ForwardAnt ant, const Arrival& arrival);
  bool take(BackwardAnt ant, const Arrival& arrival);
  bool take(Data data, const Arrival& arrival);
  bool take(const Control& control, const Arrival& arrival);

  HopLayer hops_;
  RouteTable table_;
  Forwarding forwarding_{hops_.node(), table_, hops_.outbox()};
  Flooding flooding_{hops_.node(), hops_.outbox()};
  Ants ants_{hops_.node(), table_, hops_.outbox(), forwarding_};
};

}  // namespace hal::node::routing
