#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace programs::netns {

/// What `baraka-holder enter` does: runs a program inside an agent of a run that is under way, with
/// this process's terminal, environment and folder, and with the run's clock. Root goes inside
/// another user's run as that user.
/// @param folder  results folder. @param command  empty: the user's shell.
/// @return its exit status, 128 + signal if one killed it. @throws std::runtime_error
int go_inside(const std::filesystem::path& folder, const std::string& agent,
              const std::vector<std::string>& command);

}  // namespace programs::netns
