#pragma once

#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "hal/node/routing/flooding.h"
#include "hal/node/routing/hop_layer.h"
#include "hal/node/routing/protocol.h"

namespace hal::node::routing {

/// Routes that are given once and never change (StaticConfig::routes): one next hop for each
/// destination, for all message classes, and no control packets. A message to a destination without
/// a route ends as kNoRoute, where that is found; one that a next hop does not acknowledge ends
/// with the link's verdict, and the route stays. Broadcasts are flooded as by the other protocols.
///
/// The routes are reported to the observer once for each class that was seen at this node. Of the
/// path statistics only the number of hops is known.
class StaticRouting final : public Protocol, private HopListener {
 public:
  /// @pre config.statics.routes has at most one route for each destination, none to or via `self`.
  StaticRouting(AgentId self, const RoutingConfig& config, const RouterStreams& streams,
                const RouterPorts& ports);

  void send(const Message& message) override;
  /// No effect: nothing could find the route again.
  void invalidate(std::string_view, AgentId) override {}
  std::vector<Route> routes(std::string_view topic, AgentId destination) const override;
  std::vector<Route> routes() const override;
  std::vector<Neighbour> neighbours() const override { return hops_.neighbours(); }
  bool on_frame(const Reception& reception, std::span<const std::uint8_t> bytes) override;
  void on_transmitted(const Transmission& transmission) override;

 private:
  bool on_packet(Packet packet, const Arrival& arrival) override;
  void on_no_answer(AgentId) override {}
  void on_sent(Transit transit, Verdict verdict) override;

  void on_data(Data data, AgentId from);
  void forward(Transit transit);
  void note_class(std::string_view topic);
  const StaticRoute* find(AgentId destination) const;

  HopLayer hops_;
  Node& node_;
  Flooding flooding_{node_, hops_.outbox()};
  std::vector<StaticRoute> table_;  ///< By destination.
  std::set<std::string, std::less<>> classes_;
  Memory<std::pair<AgentId, Sequence>, Seen> delivered_;
  /// A copy that the link delivered twice has the same number of transmissions.
  Memory<std::tuple<AgentId, Sequence, std::uint8_t>, Seen> relayed_;
};

}  // namespace hal::node::routing
