#pragma once

namespace baraka::run::controllers {

/// Warns on standard error of each folder of BARAKA_CONTROLLER_PATH that is not there. Each is
/// named once in a process, however many controllers are looked for. Not thread-safe.
void warn_of_missing_controller_folders();

}  // namespace baraka::run::controllers
