#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "programs/models/model.h"

namespace programs::models {

/// A mass and where its link is.
struct PlacedInertial {
  Eigen::Isometry3d pose;
  Inertial inertial;
};

/// The sum of masses that are fixed to each other, by the parallel-axis theorem: mass, centre, and
/// tensor about it along the axes of the common frame. @pre at least one
Inertial merged(const std::vector<PlacedInertial>& parts);

/// @throws ModelError  no solid body has the mass or the tensor (hal/files/description/rigid.h).
void check_solid(const Inertial& inertial, const std::string& link);

}  // namespace programs::models
