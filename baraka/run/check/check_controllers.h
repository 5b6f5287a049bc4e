#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "baraka/run/controllers/controllers_of_run.h"
#include "programs/netns/program_time.h"
#include "sim/scenario/scenario.h"

namespace baraka::run::check {

/// The parts of the command line that decide whether a scenario can be run.
struct RunMode {
  controllers::ControllersFrom controllers = controllers::ControllersFrom::kSpawn;
  bool has_domain = false;   ///< A DDS domain is used, even with controllers in this process.
  bool is_repeated = false;  ///< Repeats a record, without programs and commands from outside.
  /// How time passes for programs; none: as without `--pace`.
  std::optional<programs::netns::ProgramTime> time{};
};

/// Result of checking a scenario's controllers without running them.
struct ControllerFindings {
  std::vector<std::string> mistakes;     ///< "file:line:column: key: what is wrong".
  std::vector<std::string> warnings;     ///< "file:line:column: warning: key: what is doubtful".
  std::vector<std::string> not_checked;  ///< One line for each thing not checked, with the reason.
  /// Declared units of the values that controllers record, by controller and name.
  std::map<std::pair<std::string, std::string>, std::string> recorded_units{};
  /// States that controllers declare, and names of values that they declare to record.
  std::vector<sim::scenario::Countable> declared{};
};

/// Loads the plug-in of each controller and checks against it: the agents' kinds and parameters,
/// the channels that agents offer, the agents and topics that parameters name, the states that end
/// conditions wait for, and the recorded values that the scenario observes. A controller that is
/// missing in the form that the run needs is a mistake.
ControllerFindings check_controllers(const sim::scenario::Scenario& scenario,
                                     const RunMode& mode = {});

}  // namespace baraka::run::check
