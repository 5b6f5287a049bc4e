#include "sim/scenario/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include "sim/scenario/topic_parts.h"

namespace sim::scenario {

std::vector<ProcessPlan> plan_processes(const Scenario& scenario) {
  std::vector<ProcessPlan> plans;
  for (const Group& group : scenario.groups) {
    if (group.program.empty()) continue;
    const auto processes = static_cast<std::size_t>(group.processes);
    const std::size_t share = group.agents.size() / processes;
    const std::size_t larger = group.agents.size() % processes;
    auto next = group.agents.begin();
    for (std::size_t i = 0; i < processes; ++i) {
      ProcessPlan plan{group.name, group.program, group.program_place, {}, group.inside};
      if (processes > 1) plan.process = fmt::format("{}-{}", group.name, i + 1);
      const auto end = next + static_cast<std::ptrdiff_t>(share + (i < larger ? 1 : 0));
      plan.agents.assign(next, end);
      next = end;
      plans.push_back(std::move(plan));
    }
  }
  return plans;
}

namespace {

const agents::AgentConfig* config_of(hal::AgentId id, const Scenario& scenario) {
  const auto& all = scenario.simulation.agents;
  const auto found = std::ranges::find(all, id, &agents::AgentConfig::id);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

ProgramWords words_of(const PlannedProgram& planned, const Scenario& scenario,
                      const std::filesystem::path& results) {
  const agents::AgentConfig* const agent = config_of(planned.agent, scenario);
  const auto& group = planned.group->agents;
  return {.agent = planned.agent_name,
          .address = agent != nullptr && agent->network ? dotted(agent->network->address) : "",
          .number = std::to_string(std::ranges::find(group, planned.agent) - group.begin()),
          .results = results.empty() ? "" : std::filesystem::absolute(results).string()};
}

std::vector<PlannedProgram> plan_programs(const Scenario& scenario) {
  std::vector<PlannedProgram> planned;
  const auto add = [&](const Group& group, const Program& program, hal::AgentId agent) {
    const agents::AgentConfig* const config = config_of(agent, scenario);
    if (config == nullptr) return;  // its address is in use, which was reported
    PlannedProgram one{&group, &program, agent, config->name, {}};
    one.log = filled_in(program.log, words_of(one, scenario, {}));
    one.start = hal::Time{} + program.start;
    planned.push_back(std::move(one));
  };
  for (const Group& group : scenario.groups) {
    for (const Program& program : group.programs) {
      for (const hal::AgentId agent : group.agents) add(group, program, agent);
    }
    if (!group.player) continue;
    for (const hal::AgentId agent : group.agents) {
      if (has_topics(scenario, group, agent)) add(group, *group.player, agent);
    }
  }
  std::ranges::stable_sort(planned, {}, &PlannedProgram::start);
  return planned;
}

std::vector<PlannedProgram> plan_held_programs(const Scenario& scenario) {
  std::vector<PlannedProgram> planned = plan_programs(scenario);
  for (PlannedProgram& one : planned) {
    const std::string stream = one.agent_name + "/programs/" + one.program->name;
    const double share = hal::RandomStream(scenario.simulation.seed, stream).uniform();
    one.start += hal::from_seconds(share * hal::to_seconds(kStartSpread));
  }
  std::ranges::stable_sort(planned, {}, &PlannedProgram::start);
  return planned;
}

}  // namespace sim::scenario
