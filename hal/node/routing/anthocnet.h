#pragma once

#include "hal/node/routing/anthocnet_forwarding.h"
#include "hal/node/routing/anthocnet_mac_time.h"
#include "hal/node/routing/flooding.h"
#include "hal/node/routing/hop_layer.h"
#include "hal/node/routing/protocol.h"

namespace hal::node::routing {

/// AntHocNet in full: reactive path setup by ants, stochastic forwarding by pheromone, diffusion of
/// pheromone by hellos, proactive ants during a session, notices of broken links, local repair
/// (sources: anthocnet_config.h). Pheromone is kept by message class and destination, as routes are
/// by the other algorithms. Messages to everyone are flooded as in ant routing (flooding.h).
class AntHocNet final : public Protocol, private HopListener, private anthocnet::AntListener {
 public:
  AntHocNet(AgentId self, const RoutingConfig& config, const RouterStreams& streams,
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
  void on_home(const anthocnet::Target& target, anthocnet::AntKind kind,
               Sequence sequence) override;
  void on_trail(const anthocnet::Target& target) override;

  bool take(Data data, const Arrival& arrival);
  bool take(const Control& control, const Arrival& arrival);
  bool take(const ForwardAnt&, const Arrival&) { return true; }   // ant of another protocol
  bool take(const BackwardAnt&, const Arrival&) { return true; }  // likewise
  bool take(anthocnet::ForwardAnt ant, const Arrival& arrival);
  bool take(anthocnet::BackwardAnt ant, const Arrival& arrival);
  bool take(const anthocnet::PheromoneHello& hello, const Arrival& arrival);
  bool take(const anthocnet::LossNotice& notice, const Arrival& arrival);
  bool take(const anthocnet::Warning& warning, const Arrival& arrival);

  anthocnet::MacTime mac_time_;
  HopLayer hops_;
  anthocnet::PheromoneTable table_;
  anthocnet::AntNode node_{hops_.node(), hops_.outbox(), table_};
  anthocnet::Diffusion diffusion_;
  anthocnet::Ants ants_{node_, diffusion_, *this};
  anthocnet::Backlog backlog_{node_.node};
  anthocnet::Losses losses_{node_};
  anthocnet::PathSetup setup_{node_, diffusion_, ants_, backlog_,
                              [this](const anthocnet::Target& target) { on_trail(target); }};
  anthocnet::Repair repair_{node_, ants_, backlog_, losses_};
  anthocnet::Sessions sessions_{node_, ants_};
  anthocnet::DataForwarding forwarding_{
      node_, {diffusion_, backlog_, setup_, repair_, sessions_, losses_}};
  Flooding flooding_{node_.node, node_.outbox};
};

}  // namespace hal::node::routing
