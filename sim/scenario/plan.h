#pragma once

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// One controller process of a run.
struct ProcessPlan {
  std::string process;  ///< Name of the group; with several processes "name-1", "name-2", ...
  std::string program;
  std::string program_place;
  std::vector<hal::AgentId> agents;  ///< At least one; consecutive in order of declaration.
  bool inside = false;               ///< Runs in the network namespace of its only agent.
};

/// Distributes the agents over controller processes in order of declaration. The processes of a
/// group get equal shares; if the division leaves a remainder, the first ones get one agent more.
std::vector<ProcessPlan> plan_processes(const Scenario& scenario);

/// One program of a run.
struct PlannedProgram {
  const Group* group = nullptr;
  const Program* program = nullptr;
  hal::AgentId agent;
  std::string agent_name;
  std::string log;  ///< File in the folder of results.
};

/// Every program of every agent, ordered by start time and then by declaration. Points into the
/// scenario.
std::vector<PlannedProgram> plan_programs(const Scenario& scenario);

/// Values of the placeholders in a planned program's command and environment.
/// @param results  the folder; empty: not known yet.
ProgramWords words_of(const PlannedProgram& planned, const Scenario& scenario,
                      const std::filesystem::path& results);

}  // namespace sim::scenario
