#pragma once

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// One controller process of a run.
struct ProcessPlan {
  std::string process;  ///< The group's name; with several processes "name-1", "name-2", ...
  std::string program;
  std::string program_place;
  std::vector<hal::AgentId> agents;  ///< At least one; consecutive in order of declaration.
};

/// How the scenario spreads its agents over controller processes, in order of declaration. The
/// processes of a group get equal shares, the first ones one agent more where it does not divide.
std::vector<ProcessPlan> plan_processes(const Scenario& scenario);

}  // namespace sim::scenario
