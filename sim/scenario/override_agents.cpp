#include "sim/scenario/override_agents.h"

#include <fmt/format.h>

#include "hal/types/pattern.h"

namespace sim::scenario {

std::vector<agents::AgentConfig*> OverrideAgents::agents_key(Fields& io, std::string& pattern) {
  io.needed_text({"agents", "Name of an agent, or a pattern with * for several.", "NAME0"},
                 pattern);
  if (io.reading() == nullptr) return {};
  std::vector<agents::AgentConfig*> fitting;
  std::string clash;
  for (agents::AgentConfig& agent : group_) {
    if (!hal::matches(pattern, agent.name)) continue;
    fitting.push_back(&agent);
    const auto [first, is_new] = pattern_of_.emplace(agent.name, pattern);
    if (is_new || !clash.empty()) continue;
    clash = fmt::format("'{}' and '{}' overlap: both match {}", first->second, pattern, agent.name);
  }
  if (!clash.empty()) io.mistake("agents", clash);
  if (fitting.empty() && !pattern.empty() && !group_.empty()) {
    io.mistake("agents", fmt::format("unknown agent: '{}' matches none of this group, {} .. {}",
                                     pattern, group_.front().name, group_.back().name));
  }
  return fitting;
}

}  // namespace sim::scenario
