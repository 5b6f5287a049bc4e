#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "sim/agents/simulation_config.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {

/// The agents of the entries of a group's `overrides`: each entry has a pattern, and no agent may
/// match two.
class OverrideAgents {
 public:
  explicit OverrideAgents(std::span<agents::AgentConfig> group) : group_(group) {}

  /// `agents` of the next entry. A pattern that matches no agent, or one already matched, is a
  /// mistake.
  /// @return when reading, the agents that match.
  std::vector<agents::AgentConfig*> agents_key(Fields& io, std::string& pattern);

 private:
  std::span<agents::AgentConfig> group_;
  std::map<std::string, std::string> pattern_of_;  ///< By name of the agent.
};

}  // namespace sim::scenario
