#pragma once

#include <vector>

#include "hal/node/routing/routing_config.h"
#include "hal/types/agent_id.h"
#include "sim/agents/simulation_config.h"

namespace results::record {

/// The routing protocol of each agent, and the configuration of the protocols.
class Protocols {
 public:
  explicit Protocols(const sim::agents::SimulationConfig& config);

  /// @return null if there is no such agent.
  const hal::node::routing::ProtocolKind* of(hal::AgentId agent) const {
    return agent.value < kinds_.size() ? kinds_[agent.value] : nullptr;
  }
  const hal::node::routing::RoutingConfig& config() const { return config_; }

 private:
  hal::node::routing::RoutingConfig config_;
  std::vector<const hal::node::routing::ProtocolKind*> kinds_;  ///< By address.
};

}  // namespace results::record
