#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gateway::process {

/// The first executable file with that name in the folders; nullopt if there is none. `name` is a
/// plain file name.
std::optional<std::filesystem::path> find_program(
    const std::string& name, const std::vector<std::filesystem::path>& folders);

}  // namespace gateway::process
