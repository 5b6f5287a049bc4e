#pragma once

#include "hal/node/routing/anthocnet_config.h"
#include "hal/node/routing/anthocnet_pheromone.h"
#include "hal/node/routing/outbox.h"

namespace hal::node::routing::anthocnet {

/// Shared by all parts of AntHocNet at one node.
struct AntNode {
  Node& node;
  Outbox& outbox;
  PheromoneTable& table;

  const AntHocNetConfig& config() const { return node.config.anthocnet; }

  void send(AgentId next_hop, const ControlPacket& packet) const {
    outbox.send_control(next_hop, Control{ControlOf::kAntHocNet, encode_control(packet)});
  }

  /// Cost of a path, 1 / tau of (A3), s: the mean of its expected time and of hops times T_hop.
  double cost(int hops, Duration delay) const {
    const double idle = to_seconds(config().hop_time);
    return (to_seconds(delay) + hops * idle) / 2;
  }
  /// Cost of the hop to a neighbour, s: (A3) with 1 hop and the link's expected delay.
  double hop_cost() const { return cost(1, node.ports.link.expected_delay()); }
  /// tau of (A3), 1/s.
  double pheromone_of(const PathStatistics& path) const { return 1 / cost(path.hops, path.delay); }
};

}  // namespace hal::node::routing::anthocnet
