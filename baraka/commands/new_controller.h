#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace baraka::commands {

struct NewControllerOptions {
  std::string name;            ///< Of the program: a-z, 0-9 and _, a letter first.
  bool for_mote = false;       ///< Else for a robot.
  std::string from{};          ///< Template, one of new_controller_models(); empty: the kind's.
  std::filesystem::path to{};  ///< Folder that gets the project's folder; empty: the current one.
};

/// Names of what a project can begin with instead of the bare template of a robot.
std::vector<std::string> new_controller_models();

/// Writes a project for a controller: sources, scenario, test, from the templates in share/baraka.
/// @return exit status: kUsage if the name is none, or its folder is there already.
/// @throws std::exception  the templates are missing or the project cannot be written; then nothing
///   is left of it.
int new_controller(const NewControllerOptions& options);

}  // namespace baraka::commands
