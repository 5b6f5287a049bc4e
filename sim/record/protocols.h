#pragma once

#include <vector>

#include "hal/routing/routing_config.h"
#include "hal/types/agent_id.h"
#include "sim/agents/simulation_config.h"

namespace sim::record {

/// Which routing protocol each agent speaks, and how it is set.
class Protocols {
 public:
  explicit Protocols(const agents::SimulationConfig& config);

  /// Null: there is no such agent.
  const hal::routing::ProtocolKind* of(hal::AgentId agent) const {
    return agent.value < kinds_.size() ? kinds_[agent.value] : nullptr;
  }
  const hal::routing::RoutingConfig& config() const { return config_; }

 private:
  hal::routing::RoutingConfig config_;
  std::vector<const hal::routing::ProtocolKind*> kinds_;  ///< By address.
};

}  // namespace sim::record
