#pragma once

#include <Eigen/Geometry>
#include <variant>
#include <vector>

#include "programs/models/model.h"

namespace programs::models {

/// Upright shapes, which are what a simulated robot is made of. m, rad
struct UprightBox {
  Eigen::Vector3d centre, size;  ///< size along its own axes
  double yaw = 0;
};
struct UprightCylinder {
  Eigen::Vector2d centre;
  double radius = 0, bottom = 0, top = 0;
};
using Upright = std::variant<UprightBox, UprightCylinder>;

/// The smallest upright shape around a shape. It is the shape itself if that is an upright cylinder
/// or a box that stands on a face. A ball becomes a cylinder; a tilted cylinder or capsule, the box
/// along its axis; a tilted box or the hull of points, the box of least area around its shadow or
/// the smallest circle, whichever is smaller.
/// @param pose  of the shape.
Upright upright(const Shape& shape, const Eigen::Isometry3d& pose);

/// Lowest and highest z of a shape, m.
struct Heights {
  double low = 0, high = 0;
};
Heights heights(const Upright& shape);
Eigen::Vector3d centre_of(const Upright& shape);

/// Its edges or its diameter and height are at least 1 mm.
/// @return false: all of it is below z = 0. Otherwise what is below is cut off.
bool cut_at_ground(Upright& shape);

/// Distance of the shape's farthest point from an axis. m
/// @param at  a point of the axis. @param along  unit vector
double reach(const Shape& shape, const Eigen::Isometry3d& pose, const Eigen::Vector3d& at,
             const Eigen::Vector3d& along);

}  // namespace programs::models
