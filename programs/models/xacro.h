#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "programs/models/model.h"

namespace programs::models {

/// The line of the first element of xacro in a text; nullopt: there is none.
std::optional<Line> first_of_xacro(const std::string& text);

/// What the program `xacro` (ROS) makes of a file. @throws ModelError  it is not in PATH, or fails.
/// @param line  for messages
std::string expanded_by_xacro(const std::filesystem::path& file, Line line);

}  // namespace programs::models
