#pragma once

#include <filesystem>
#include <string>

#include "programs/models/model.h"
#include "programs/models/search_path.h"

namespace programs::models {

/// Reads a robot in URDF (wiki.ros.org/urdf/XML). It is read here and not by libsdformat, whose
/// conversion knows no lines and leaves out links without mass, with what is fixed to them.
/// A file with elements of xacro is expanded by the program `xacro`, and lines are those of its
/// output.
/// @throws ModelError
Model read_urdf(const std::filesystem::path& file, const SearchPath& search);

/// The same of a text.
Model parse_urdf(const std::string& text, const SearchPath& search);

}  // namespace programs::models
