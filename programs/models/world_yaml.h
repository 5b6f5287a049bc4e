#pragma once

#include <string>

#include "programs/models/sdf_reader.h"

namespace programs::models {

/// `walls:` and `movables:` of a scenario's world, with lines as in robot_yaml().
///
/// Of a static model, each collision shape is a box from the ground up; spheres and upright
/// cylinders become the boxes around them. A model that can move is one body: its shape as a box, a
/// cylinder or a sphere, or the smallest upright box or cylinder around its shapes, with the sum of
/// its masses.
std::string world_yaml(const WorldModels& world, const std::string& file);

}  // namespace programs::models
