#include "sim/agents/paths.h"

#include <variant>

#include "sim/agents/simulation_config.h"

namespace sim::agents {

Paths::Paths(const SimulationConfig& config) {
  for (const AgentConfig& agent : config.agents) {
    const auto* station = std::get_if<Station>(&agent.body);
    if (station == nullptr) continue;
    if (agent.id.value >= paths_.size()) paths_.resize(agent.id.value + 1u);
    paths_[agent.id.value] = make_path(station->path, agent.pose, config.seed, agent.name);
  }
}

}  // namespace sim::agents
