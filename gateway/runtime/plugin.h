#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hal/api/controller.h"
#include "hal/types/result.h"

namespace gateway::runtime {

/// The folders of the environment variable BARAKA_CONTROLLER_PATH, separated by colons, whether
/// they exist or not.
std::vector<std::filesystem::path> named_controller_folders();

/// Search path for controllers: named_controller_folders(), so that a user's controller precedes a
/// shipped one of the same name; then the folder of this executable, in an installation also
/// ../lib/baraka.
std::vector<std::filesystem::path> controller_folders();

/// Loads `<name>.so` from the first of the folders that has it, or the Python file `name` if that
/// ends in ".py", and asks it for its controller. The file stays loaded until the process ends, so
/// the result is always valid. Not thread safe.
/// Errors: kNotAvailable (in none of the folders, which are named), kInvalidArgument (`name` is not
/// a plain file name, or the file is not a controller), kProtocol (it cannot be loaded, or was
/// built with other headers).
hal::Result<const hal::ControllerKind*> load_plugin(
    std::string_view name, const std::vector<std::filesystem::path>& folders);

}  // namespace gateway::runtime
