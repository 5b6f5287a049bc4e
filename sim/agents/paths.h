#pragma once

#include <memory>
#include <vector>

#include "hal/types/agent_id.h"
#include "sim/agents/path.h"

namespace sim::agents {

struct SimulationConfig;

/// The paths of a run's agents without bodies.
class Paths {
 public:
  explicit Paths(const SimulationConfig& config);

  /// Path of an agent; null if the agent has a body.
  const Path* find(hal::AgentId agent) const {
    return agent.value < paths_.size() ? paths_[agent.value].get() : nullptr;
  }

 private:
  std::vector<std::unique_ptr<const Path>> paths_;  ///< By address.
};

}  // namespace sim::agents
