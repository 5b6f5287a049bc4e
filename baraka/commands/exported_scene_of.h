#pragma once

#include <filesystem>

#include "results/report/exported_scene.h"

namespace baraka::commands {

/// Of the scenario that is stored with a result.
/// @throws hal::files::config::ConfigErrors  it is not there or damaged.
results::report::ExportedScene exported_scene_of(const std::filesystem::path& folder);

}  // namespace baraka::commands
