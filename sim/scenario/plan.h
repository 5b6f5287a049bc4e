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
  std::string log;  ///< File in the results' folder.
  hal::Time start{};
};

/// Every program of every agent, ordered by start time and then by declaration. Points into the
/// scenario.
std::vector<PlannedProgram> plan_programs(const Scenario& scenario);

/// The same for lock-step: each starts up to this later, at a time drawn from the seed. Programs
/// take no time there to load; of those that started at one instant on several agents, all that
/// they send periodically would collide for ever.
inline constexpr hal::Duration kStartSpread = std::chrono::milliseconds{10};
std::vector<PlannedProgram> plan_held_programs(const Scenario& scenario);

/// What the words in a planned program's command and environment stand for.
/// @param results  the folder; empty: not known yet.
ProgramWords words_of(const PlannedProgram& planned, const Scenario& scenario,
                      const std::filesystem::path& results);

}  // namespace sim::scenario
