#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gateway {

/// The first executable file of that name in the folders; nothing if there is none. `name` is a
/// plain file name.
std::optional<std::filesystem::path> find_program(
    const std::string& name, const std::vector<std::filesystem::path>& folders);

}  // namespace gateway
