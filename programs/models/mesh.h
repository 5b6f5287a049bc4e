#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

namespace programs::models {

/// Corners of a mesh in the file's unit and axes (STL, DAE, OBJ and what else assimp reads), scaled
/// along its axes. Nodes of a scene are put in place; a unit in a DAE file counts.
/// @throws std::runtime_error  it is not a mesh, has no corner or one that is not finite.
std::vector<Eigen::Vector3d> mesh_points(const std::filesystem::path& file,
                                         const Eigen::Vector3d& scale);

}  // namespace programs::models
