#include "sim/scenario/agent_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "hal/files/config/suggest.h"
#include "hal/types/check.h"
#include "hal/types/pattern.h"

namespace sim::scenario {

using hal::AgentId;

AgentId agent_named(Mapping& in, const std::string& key, const std::string& name,
                    const Scenario& scenario) {
  std::vector<std::string> names;
  for (const agents::AgentConfig& agent : scenario.simulation.agents) {
    if (agent.name == name) return agent.id;
    names.push_back(agent.name);
  }
  if (!name.empty()) {
    in.mistake(key, fmt::format("unknown agent '{}'{}", name,
                                hal::files::config::suggestion(name, names)));
  }
  return AgentId{};
}

std::vector<AgentId> agents_like(const std::string& pattern, const Scenario& scenario) {
  std::vector<AgentId> matching;
  for (const agents::AgentConfig& agent : scenario.simulation.agents) {
    if (hal::matches(pattern, agent.name)) matching.push_back(agent.id);
  }
  return matching;
}

std::vector<AgentId> agents_meant(Mapping& in, const std::string& key, const std::string& name,
                                  const Scenario& scenario) {
  if (name.find_first_of("*?") == std::string::npos) {
    const AgentId agent = agent_named(in, key, name, scenario);
    return agent == AgentId{} ? std::vector<AgentId>{} : std::vector{agent};
  }
  std::vector<AgentId> matching = agents_like(name, scenario);
  if (matching.empty()) in.mistake(key, fmt::format("'{}' matches no agent", name));
  return matching;
}

const agents::AgentConfig& declared(AgentId id, const Scenario& scenario) {
  const auto& all = scenario.simulation.agents;
  const auto found = std::ranges::find(all, id, &agents::AgentConfig::id);
  BARAKA_CHECK(found != all.end());
  return *found;
}

bool has_battery(const agents::AgentConfig& agent) {
  return std::ranges::any_of(sensors_of(agent), [](const auto& sensor) {
    return std::holds_alternative<hal::node::devices::Battery>(sensor);
  });
}

}  // namespace sim::scenario
