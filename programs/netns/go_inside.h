#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace programs::netns {

/// Implements `baraka-holder enter`: runs a program inside an agent of a running simulation, with
/// this process's terminal, environment and folder, and with the run's clock. If root enters the
/// run of another user, it becomes that user.
/// @param folder  results folder. @param command  empty: the user's shell.
/// @return exit status of the program, 128 + signal if a signal killed it. @throws
/// std::runtime_error
int go_inside(const std::filesystem::path& folder, const std::string& agent,
              const std::vector<std::string>& command);

}  // namespace programs::netns
