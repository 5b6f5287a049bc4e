#pragma once

#include "hal/routing/anthocnet_config.h"
#include "hal/routing/anthocnet_pheromone.h"
#include "hal/routing/outbox.h"

namespace hal::routing::anthocnet {

/// What all parts of AntHocNet at one node share.
struct AntNode {
  Node& node;
  Outbox& outbox;
  PheromoneTable& table;

  const AntHocNetConfig& config() const { return node.config.anthocnet; }

  void send(AgentId next_hop, const ControlPacket& packet) const {
    outbox.send_control(next_hop, Control{ControlOf::kAntHocNet, encode_control(packet)});
  }

  /// Cost of one hop, or of a path, whose inverse is pheromone: the mean of the time it takes and
  /// of hops times T_hop, s ([PPSN], 3.1).
  double cost(int hops, Duration delay) const {
    const double idle = to_seconds(config().hop_time);
    return (to_seconds(delay) + hops * idle) / 2;
  }
  double hop_cost() const { return cost(1, node.ports.link.expected_delay()); }
  double pheromone_of(const PathStatistics& path) const { return 1 / cost(path.hops, path.delay); }
};

}  // namespace hal::routing::anthocnet
