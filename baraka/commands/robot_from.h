#pragma once

#include <string>
#include <vector>

namespace baraka::commands {

struct RobotFromOptions {
  std::string file;                  ///< URDF or SDF.
  std::string drive;                 ///< `drive:` of a robot, as YAML; empty: that of the file.
  std::string model;                 ///< Which model of an SDF file; empty: the only one.
  std::vector<std::string> folders;  ///< Where package:// and model:// are searched for.
};

/// Prints a robot in URDF or SDF as a robot file. @return exit status.
/// @throws hal::files::config::ConfigErrors  it cannot be read.
int robot_from(const RobotFromOptions& options);

}  // namespace baraka::commands
