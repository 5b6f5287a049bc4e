#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gateway/run/controllers_of_run.h"
#include "sim/scenario/scenario.h"

namespace gateway {

/// How a scenario is to be run, as far as that decides whether it can be.
struct RunWay {
  ControllersFrom controllers = ControllersFrom::kSpawn;
  bool has_domain = false;   ///< Also with controllers in this process.
  bool is_repeated = false;  ///< From its record, without programs and commands from outside.
  double factor = 1;         ///< Of the programs' time.
};

/// What the scenario says about its controllers, judged without running them.
struct ControllerJudgement {
  std::vector<std::string> mistakes;     ///< "file:line:column: key: what is wrong".
  std::vector<std::string> warnings;     ///< "file:line:column: warning: key: what is doubtful".
  std::vector<std::string> not_checked;  ///< What could not be judged, and why; a line each.
  /// Units of what controllers record, by controller and name, as far as they declare it.
  std::map<std::pair<std::string, std::string>, std::string> recorded_units{};
  /// States that controllers enter and names that they record, as far as they declare them.
  std::vector<sim::record::Countable> declared{};
};

/// Loads the plug-in of each program, and checks against it the agents' kinds and parameters, the
/// channels they offer, the agents and topics that parameters name, the states that end conditions
/// wait for, and what is observed of what they record. A program that is not there in the form that
/// the run needs is a mistake.
ControllerJudgement judge_controllers(const sim::scenario::Scenario& scenario,
                                      const RunWay& way = {});

struct JudgedScenario {
  sim::scenario::Scenario scenario;
  std::vector<std::string> remarks;  ///< Warnings, and what could not be judged; a line each.
};

/// Reads a scenario and judges its controllers and programs, for every command that runs or shows
/// one, and for `check`.
/// @param overrides  as for load_scenario(). @throws hal::config::ConfigErrors
JudgedScenario judge_scenario(const std::filesystem::path& file,
                              const std::vector<std::string>& overrides, const RunWay& way = {});

/// The same, with the remarks on standard error. @param path  or name of a shipped scenario.
sim::scenario::Scenario load_judged(const std::string& path,
                                    const std::vector<std::string>& overrides,
                                    const RunWay& way = {});

}  // namespace gateway
