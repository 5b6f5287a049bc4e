#include "results/record/protocols.h"

namespace results::record {

Protocols::Protocols(const sim::agents::SimulationConfig& config) : config_(config.routing) {
  for (const sim::agents::AgentConfig& agent : config.agents) {
    if (agent.id.value >= kinds_.size()) kinds_.resize(agent.id.value + 1u);
    kinds_[agent.id.value] = &agent.routing.value_or(config.routing.algorithm).kind();
  }
}

}  // namespace results::record
