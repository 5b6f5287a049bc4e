#pragma once

#include <filesystem>

#include "sim/report/exported_scene.h"

namespace gateway {

/// Of the scenario that is stored with a result.
/// @throws hal::config::ConfigErrors  it is not there or damaged.
sim::report::ExportedScene exported_scene_of(const std::filesystem::path& folder);

}  // namespace gateway
