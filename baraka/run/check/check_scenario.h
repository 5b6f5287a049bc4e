#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "baraka/run/check/check_controllers.h"
#include "sim/scenario/scenario.h"

namespace baraka::run::check {

struct CheckedScenario {
  sim::scenario::Scenario scenario;
  std::vector<std::string> remarks;  ///< Warnings, and what could not be checked: one line each.
};

/// Reads a scenario and checks its controllers and programs. Used by `check` and by every command
/// that runs or shows a scenario.
/// @param overrides  as for load_scenario().
/// @throws hal::files::config::ConfigErrors
CheckedScenario check_scenario(const std::filesystem::path& file,
                               const std::vector<std::string>& overrides, const RunMode& mode = {});

/// The same, with the remarks on standard error.
/// @param path  of the scenario's file, or the name of a shipped scenario.
sim::scenario::Scenario load_checked(const std::string& path,
                                     const std::vector<std::string>& overrides,
                                     const RunMode& mode = {});

}  // namespace baraka::run::check
