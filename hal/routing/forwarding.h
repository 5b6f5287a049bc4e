#pragma once

#include <tuple>

#include "hal/routing/discovery.h"
#include "hal/routing/memory.h"
#include "hal/routing/route_table.h"

namespace hal::routing {

/// Takes messages hop by hop to one destination: sends its own, relays those of others, delivers
/// those for this node, and finds another way for those the next hop did not acknowledge.
class Forwarding {
 public:
  Forwarding(Node& node, RouteTable& table, Outbox& outbox);

  void send(const Message& message);
  void on_data(Data data, AgentId from);

  /// How the link did with a message.
  void on_sent(Transit transit, Verdict verdict);

  /// A route is there: sends what waited for it.
  void on_route(const std::string& topic, AgentId destination);

  Discovery& discovery() { return discovery_; }

 private:
  void forward(Transit transit, Verdict verdict_if_exhausted);

  Node& node_;
  RouteTable& table_;
  Outbox& outbox_;
  Discovery discovery_;
  Memory<std::pair<AgentId, Sequence>, Seen> delivered_;
  /// A copy that the link gave us twice (its acknowledgement was lost) repeats the number of
  /// transmissions; a message that comes by again on a longer way does not, and travels on.
  Memory<std::tuple<AgentId, Sequence, std::uint8_t>, Seen> relayed_;
};

}  // namespace hal::routing
