#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hal/api/controller.h"
#include "hal/types/result.h"

namespace hal::runtime {

/// The folders of the environment variable BARAKA_CONTROLLER_PATH, separated by colons, whether
/// they are there or not.
std::vector<std::filesystem::path> named_controller_folders();

/// Where controllers are looked for: in the named_controller_folders(), so that one's own goes
/// before ours of the same name; then beside this executable, where it is installed also in
/// ../lib/baraka.
std::vector<std::filesystem::path> controller_folders();

/// Loads `<name>.so` from the first of the folders that has it, and asks it for its controller. It
/// stays loaded until the process ends, so the result is good for ever. Not thread safe.
/// Errors: kNotAvailable (in none of the folders: names them), kInvalidArgument (`name` is not a
/// plain file name, or is no controller), kProtocol (cannot be loaded, was built with other
/// headers).
Result<const ControllerKind*> load_plugin(std::string_view name,
                                          const std::vector<std::filesystem::path>& folders);

}  // namespace hal::runtime
