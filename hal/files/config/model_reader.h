#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hal::files::config {

/// What `baraka-sdf`, the program that reads URDF and SDF, says of a file. It is a process of its
/// own, for it is of another package and its libraries may not survive the file.
struct ModelReading {
  std::string yaml;  ///< What it printed.
  /// Why it printed nothing, one each: "FILE:LINE:1: WHAT", "drive.KEY: WHAT", or other text.
  std::vector<std::string> mistakes;
};

/// Runs the program, which is beside this one, in ../bin, or in PATH.
/// @param arguments  without the name of the program.
ModelReading read_model(const std::vector<std::string>& arguments);

/// Where the program is; empty: it is not installed.
std::filesystem::path model_reader();

/// What to do if it is not.
inline constexpr const char* kNoModelReader =
    "robots in URDF and SDF are read by baraka-sdf, which is not installed: "
    "`apt install baraka-sdf`, or build with libsdformat-dev and libassimp-dev";

}  // namespace hal::files::config
