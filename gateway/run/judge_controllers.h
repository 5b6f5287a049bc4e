#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sim/scenario/scenario.h"

namespace gateway {

/// What the scenario says about its controllers, judged without running them.
struct ControllerJudgement {
  std::vector<std::string> mistakes;     ///< "file:line:column: key: what is wrong".
  std::vector<std::string> not_checked;  ///< What could not be judged, and why; a line each.
  /// Units of what controllers record, by controller and name, as far as they declare it.
  std::map<std::pair<std::string, std::string>, std::string> recorded_units{};
  /// States that controllers enter and names that they record, as far as they declare them.
  std::vector<sim::record::Countable> declared{};
};

/// Loads the plug-in of each program, and checks against it the agents' kinds and parameters, the
/// channels they offer, the states that end conditions wait for, and what is observed of what they
/// record. A program that is neither
/// found as a plug-in nor as a program is a mistake.
ControllerJudgement judge_controllers(const sim::scenario::Scenario& scenario);

/// Reads a scenario and judges its controllers; warnings and what cannot be judged are said on
/// standard error.
/// @param overrides  as for load_scenario(). @throws hal::config::ConfigErrors
sim::scenario::Scenario load_judged(const std::string& path,
                                    const std::vector<std::string>& overrides);

}  // namespace gateway
