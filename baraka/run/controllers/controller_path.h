#pragma once

namespace baraka::run::controllers {

/// Warns on standard error of each folder in BARAKA_CONTROLLER_PATH that does not exist, once per
/// process. Not thread-safe.
void warn_of_missing_controller_folders();

}  // namespace baraka::run::controllers
