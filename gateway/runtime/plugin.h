#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hal/api/controller.h"
#include "hal/types/result.h"

namespace gateway::runtime {

/// The folders of the environment variable BARAKA_CONTROLLER_PATH, separated by colons, whether
/// they are there or not.
std::vector<std::filesystem::path> named_controller_folders();

/// Search path for controllers: named_controller_folders(), so that a user's controller precedes a
/// shipped one of the same name; then the folder of this executable, in an installation also
/// ../lib/baraka.
std::vector<std::filesystem::path> controller_folders();

/// Loads `<name>.so` from the first of the folders that has it, and asks it for its controller. It
/// stays loaded until the process ends, so the result is good for ever. Not thread safe.
/// Errors: kNotAvailable (in none of the folders: names them), kInvalidArgument (`name` is not a
/// plain file name, or is no controller), kProtocol (cannot be loaded, was built with other
/// headers).
hal::Result<const hal::ControllerKind*> load_plugin(
    std::string_view name, const std::vector<std::filesystem::path>& folders);

}  // namespace gateway::runtime
