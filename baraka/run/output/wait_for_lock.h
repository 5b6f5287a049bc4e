#pragma once

#include <filesystem>
#include <memory>

#include "baraka/run/output/folder_lock.h"

namespace baraka::run::output {

/// Holds the folder of a result as soon as nobody else does: waits for a run that is writing there,
/// here or, on a file system of several computers, elsewhere. What was killed in the middle of
/// setting an earlier result aside is ended.
/// @throws Interrupted  by the user. @throws UsageError, std::runtime_error  as ResultsFolder.
std::unique_ptr<FolderLock> wait_for_lock(const std::filesystem::path& folder);

}  // namespace baraka::run::output
