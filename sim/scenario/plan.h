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
  bool inside = false;               ///< In the network of its agent, which is its only one.
};

/// How the scenario spreads its agents over controller processes, in order of declaration. The
/// processes of a group get equal shares, the first ones one agent more where it does not divide.
std::vector<ProcessPlan> plan_processes(const Scenario& scenario);

/// One program of a run.
struct PlannedProgram {
  const Group* group = nullptr;
  const Program* program = nullptr;
  hal::AgentId agent;
  std::string agent_name;
  std::string log;  ///< File in the results' folder.
};

/// Every program of every agent, by their start and then in order of declaration. It points into
/// the scenario.
std::vector<PlannedProgram> plan_programs(const Scenario& scenario);

/// What the words in a planned program's command and environment stand for.
/// @param results  the folder; empty: not known yet.
ProgramWords words_of(const PlannedProgram& planned, const Scenario& scenario,
                      const std::filesystem::path& results);

}  // namespace sim::scenario
