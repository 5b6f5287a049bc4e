#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "sim/agents/simulation_config.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {

/// Whom the entries of a group's `overrides` are for: each has a pattern, and no agent may fit two.
class OverrideAgents {
 public:
  explicit OverrideAgents(std::span<agents::AgentConfig> group) : group_(group) {}

  /// `agents` of the next entry. A pattern that fits nobody, or somebody again, is a mistake.
  /// @return those whom it fits, of what is read.
  std::vector<agents::AgentConfig*> agents_key(Fields& io, std::string& pattern);

 private:
  std::span<agents::AgentConfig> group_;
  std::map<std::string, std::string> pattern_of_;  ///< By name of the agent.
};

}  // namespace sim::scenario
