#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gateway {

/// Where controller programs are looked for: the folder of this executable, then those of
/// BARAKA_CONTROLLER_PATH (colon-separated).
std::vector<std::filesystem::path> controller_folders();

/// The first executable file of that name in the folders; nothing if there is none. `name` is a
/// plain file name.
std::optional<std::filesystem::path> find_program(
    const std::string& name, const std::vector<std::filesystem::path>& folders);

}  // namespace gateway
