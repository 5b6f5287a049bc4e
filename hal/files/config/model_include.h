#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "hal/files/config/node.h"
#include "hal/files/config/problems.h"

namespace hal::files::config {

/// `urdf: FILE` or `sdf: FILE` in a mapping, with the keys that say how the file is read: `drive`,
/// `search_path` and `sdf_model`.
struct ModelInclude {
  Node file;  ///< Value of `urdf` or `sdf`.
  bool is_urdf = false;
  Node drive, search_path, model;  ///< Null: absent.
};

/// Takes these keys from a mapping that has `urdf` or `sdf`; nullopt: it has neither, or it is no
/// robot and no world, whose keys they are.
/// @param path  of the mapping; empty: that of a robot file.
std::optional<ModelInclude> take_model(Node& mapping, const std::string& path);

/// Reads the file and gives its keys, each at its line of that file; what the robot does not have
/// becomes warnings, and mistakes are noted, in the file or in the including one.
/// @param file  where it is. @param path  of the mapping; `world` and what ends with it gets walls.
/// @param origin  order and layer of the new places.
/// @return a null node after a mistake.
Node read_model_file(const ModelInclude& include, const std::filesystem::path& file,
                     const std::string& path, const Place& origin, Problems& problems);

}  // namespace hal::files::config
