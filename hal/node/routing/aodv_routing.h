#pragma once

#include <map>
#include <vector>

#include "hal/node/routing/aodv_hello.h"
#include "hal/node/routing/aodv_search.h"
#include "hal/node/routing/aodv_table.h"
#include "hal/node/routing/flooding.h"
#include "hal/node/routing/hop_layer.h"
#include "hal/node/routing/protocol.h"
#include "hal/node/routing/rate_limit.h"

namespace hal::node::routing {

/// AODV: C. Perkins, E. Belding-Royer, S. Das, "Ad hoc On-Demand Distance Vector (AODV) Routing",
/// RFC 3561, 2003. Route requests are flooded in expanding rings. The destination, or a node with a
/// fresh enough route, answers with a route reply along the reverse path. Destination sequence
/// numbers distinguish fresh routes from old ones. A broken route is reported by route errors to
/// the nodes that use it. Numbers of formulae, (R1) to (R9): aodv_config.h.
///
/// One table serves all message classes. The link detects unidirectional links (section 6.8 permits
/// any means), so there is no RREP-ACK: a neighbour that does not acknowledge a reply is
/// blacklisted. Broadcasts are flooded as by the other protocols.
class AodvRouting final : public Protocol, private HopListener {
 public:
  AodvRouting(AgentId self, const RoutingConfig& config, const RouterStreams& streams,
              const RouterPorts& ports);

  void send(const Message& message) override;
  /// Treats the route as broken, for all classes, without a route error.
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

  bool on_control(const Control& control, AgentId from);
  void on_message(const Rreq& rreq, int ttl, AgentId from);
  void on_message(const Rrep& rrep, int ttl, AgentId from);
  void on_message(const Rerr& rerr, int ttl, AgentId from);
  bool answer(const Rreq& rreq, AgentId from);
  void answer_for_other(const Rreq& rreq, const AodvEntry& route, AgentId from);
  void relay(Rreq rreq, int ttl);
  void relay(Rrep rrep, int ttl, AgentId from);
  void send_reply(AgentId to, const Rrep& rrep, int ttl);

  void on_data(Data data, AgentId from);
  void forward(Transit transit);
  void refresh(const Data& data, AgentId from);
  void on_route(AgentId destination);
  void refuse(const Transit& transit);
  bool starts_repair(AgentId destination, const AodvEntry& before);
  void on_repair_failed(AgentId destination);
  void end(const Transit& transit, Verdict verdict);

  using Unreachable = std::vector<std::pair<AgentId, AodvSequence>>;
  void report(const Unreachable& broken, const std::set<AgentId>& listeners);

  HopLayer hops_;
  Node& node_;
  Outbox& outbox_;
  AodvTable table_;
  AodvSearch search_;
  AodvHellos hellos_;
  Flooding flooding_;
  RateLimit errors_;
  const bool has_hellos_;
  Memory<std::pair<AgentId, std::uint32_t>, Seen> requests_;
  Memory<std::pair<AgentId, Sequence>, Seen> delivered_;
  /// A copy that the link delivered twice has the same number of transmissions.
  Memory<std::tuple<AgentId, Sequence, std::uint8_t>, Seen> relayed_;
  std::map<AgentId, Time> blacklist_;  ///< Neighbours ignored, and until when.
};

}  // namespace hal::node::routing
