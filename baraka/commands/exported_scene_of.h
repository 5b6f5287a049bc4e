#pragma once

#include <filesystem>

#include "results/report/exported_scene.h"

namespace baraka::commands {

/// The scene of a result, from the scenario stored with it.
/// @throws hal::files::config::ConfigErrors  the scenario is missing or damaged.
results::report::ExportedScene exported_scene_of(const std::filesystem::path& folder);

}  // namespace baraka::commands
