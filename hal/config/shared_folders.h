#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace hal::config {

/// Where files are looked for that come with BARAKA, like robots: the folders of the environment
/// variable BARAKA_CONFIG_PATH (separated by colons), then ../share/baraka seen from this
/// executable.
std::vector<std::filesystem::path> shared_folders();

/// The first of them that has a file or folder of that relative path; nothing if none has.
std::optional<std::filesystem::path> find_shared(const std::filesystem::path& relative);

}  // namespace hal::config
