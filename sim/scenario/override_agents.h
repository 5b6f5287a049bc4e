#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "hal/config/mapping.h"
#include "sim/agents/simulation_config.h"

namespace sim::scenario {

/// Whom the entries of a group's `overrides` are for: each has a pattern, and no agent may fit two.
class OverrideAgents {
 public:
  explicit OverrideAgents(std::span<agents::AgentConfig> group) : group_(group) {}

  /// Reads `agents` of the next entry. A pattern that fits nobody, or somebody again, is a mistake.
  std::vector<agents::AgentConfig*> read(hal::config::Mapping& in);

 private:
  std::span<agents::AgentConfig> group_;
  std::map<std::string, std::string> pattern_of_;  ///< By name of the agent.
};

}  // namespace sim::scenario
