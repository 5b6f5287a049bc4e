#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace baraka::commands {

struct NewControllerOptions {
  std::string name;            ///< Name of the program: a-z, 0-9 and _, a letter first.
  bool for_mote = false;       ///< True: for a mote; false: for a robot.
  bool in_python = false;      ///< True: in Python; false: in C++.
  std::string from{};          ///< One of new_controller_models(); empty: the kind's bare template.
  std::filesystem::path to{};  ///< Parent of the project's folder; empty: the current folder.
};

/// Names of templates that can replace the bare template of a robot.
std::vector<std::string> new_controller_models();

/// Writes a project for a controller (sources, scenario and test) from the templates in
/// share/baraka.
/// @return exit status: kUsage if the name is not valid, or its folder exists.
/// @throws std::exception  the templates are missing or the project cannot be written; what was
///   written is removed.
int new_controller(const NewControllerOptions& options);

}  // namespace baraka::commands
