#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "programs/models/model.h"
#include "programs/models/search_path.h"

namespace programs::models {

/// Reads a model in SDFormat by libsdformat, which also finds poses given in other frames and
/// models that others include.
/// @param name  of the model; empty: the only one. @throws ModelError
Model read_sdf(const std::filesystem::path& file, const std::string& name,
               const SearchPath& search);

/// A model of a world, where it is in that world.
struct Placed {
  Model model;  ///< Poses of links are in the frame of the world.
  bool is_static = false;
};

/// What a world holds.
struct WorldModels {
  std::vector<Placed> models;
  std::vector<Note> notes;
};

/// Reads the only world of a file. @throws ModelError
WorldModels read_sdf_world(const std::filesystem::path& file, const SearchPath& search);

}  // namespace programs::models
