#pragma once

#include <filesystem>
#include <memory>

#include "baraka/run/output/folder_lock.h"

namespace baraka::run::output {

/// Locks the folder of a result as soon as no other process holds it: waits for a run that is
/// writing there, on this computer or, with a shared file system, on another. Completes an
/// interrupted set_aside().
/// @throws Interrupted  by the user.
/// @throws UsageError, std::runtime_error  as ResultsFolder.
std::unique_ptr<FolderLock> wait_for_lock(const std::filesystem::path& folder);

}  // namespace baraka::run::output
