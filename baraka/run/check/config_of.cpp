#include "baraka/run/check/config_of.h"

#include <algorithm>

namespace baraka::run::check {

const sim::agents::AgentConfig& config_of(const sim::scenario::Scenario& scenario,
                                          hal::AgentId id) {
  const auto& agents = scenario.simulation.agents;
  // Agents are sorted by address.
  return *std::ranges::lower_bound(agents, id, {}, &sim::agents::AgentConfig::id);
}

}  // namespace baraka::run::check
