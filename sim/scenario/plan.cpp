#include "sim/scenario/plan.h"

#include <fmt/format.h>

namespace sim::scenario {

std::vector<ProcessPlan> plan_processes(const Scenario& scenario) {
  std::vector<ProcessPlan> plans;
  for (const Group& group : scenario.groups) {
    const auto processes = static_cast<std::size_t>(group.processes);
    const std::size_t share = group.agents.size() / processes;
    const std::size_t larger = group.agents.size() % processes;
    auto next = group.agents.begin();
    for (std::size_t i = 0; i < processes; ++i) {
      ProcessPlan plan{group.name, group.program, group.program_place, {}};
      if (processes > 1) plan.process = fmt::format("{}-{}", group.name, i + 1);
      const auto end = next + static_cast<std::ptrdiff_t>(share + (i < larger ? 1 : 0));
      plan.agents.assign(next, end);
      next = end;
      plans.push_back(std::move(plan));
    }
  }
  return plans;
}

}  // namespace sim::scenario
