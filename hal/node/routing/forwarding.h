#pragma once

#include <tuple>

#include "hal/node/routing/discovery.h"
#include "hal/node/routing/memory.h"
#include "hal/node/routing/route_table.h"

namespace hal::node::routing {

/// Forwards messages hop by hop to one destination: sends those of this node, relays those of
/// others, delivers those for this node, and reroutes those that the next hop did not acknowledge.
class Forwarding {
 public:
  Forwarding(Node& node, RouteTable& table, Outbox& outbox);

  void send(const Message& message);
  void on_data(Data data, AgentId from);

  /// Result of a message at the link.
  void on_sent(Transit transit, Verdict verdict);

  /// A route was found: sends the messages that waited for it.
  void on_route(const std::string& topic, AgentId destination);

  Discovery& discovery() { return discovery_; }

 private:
  void forward(Transit transit, Verdict verdict_if_exhausted);

  Node& node_;
  RouteTable& table_;
  Outbox& outbox_;
  Discovery discovery_;
  Memory<std::pair<AgentId, Sequence>, Seen> delivered_;
  /// A copy that the link delivered twice (because its acknowledgement was lost) has the same
  /// number of transmissions; a message that returns on a longer path has another, and is
  /// forwarded.
  Memory<std::tuple<AgentId, Sequence, std::uint8_t>, Seen> relayed_;
};

}  // namespace hal::node::routing
