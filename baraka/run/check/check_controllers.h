#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "baraka/run/controllers/controllers_of_run.h"
#include "sim/scenario/scenario.h"

namespace baraka::run::check {

/// How a scenario is to be run, as far as that decides whether it can be.
struct RunMode {
  controllers::ControllersFrom controllers = controllers::ControllersFrom::kSpawn;
  bool has_domain = false;   ///< Also with controllers in this process.
  bool is_repeated = false;  ///< From its record, without programs and commands from outside.
  double factor = 1;         ///< Of the programs' time.
};

/// What the scenario says about its controllers, checked without running them.
struct ControllerFindings {
  std::vector<std::string> mistakes;     ///< "file:line:column: key: what is wrong".
  std::vector<std::string> warnings;     ///< "file:line:column: warning: key: what is doubtful".
  std::vector<std::string> not_checked;  ///< What could not be checked, and why; a line each.
  /// Units of what controllers record, by controller and name, as far as they declare it.
  std::map<std::pair<std::string, std::string>, std::string> recorded_units{};
  /// States that controllers enter and names that they record, as far as they declare them.
  std::vector<sim::scenario::Countable> declared{};
};

/// Loads the plug-in of each program, and checks against it the agents' kinds and parameters, the
/// channels they offer, the agents and topics that parameters name, the states that end conditions
/// wait for, and what is observed of what they record. A program that is not there in the form that
/// the run needs is a mistake.
ControllerFindings check_controllers(const sim::scenario::Scenario& scenario,
                                     const RunMode& mode = {});

}  // namespace baraka::run::check
