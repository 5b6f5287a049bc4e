#pragma once

#include <optional>
#include <string>

#include "hal/types/geometry.h"

namespace hal::files::description {

/// Why no solid body has this tensor of inertia about its centre of mass; nullopt: one has. Its
/// principal moments A <= B <= C must be positive with C <= A + B, for A + B - C is twice the
/// integral of a square over the mass. A share of 1e-6 of C is permitted, for files are rounded.
/// @param moments  Ixx, Iyy, Izz, kg m^2. @param products  Ixy, Ixz, Iyz, kg m^2.
std::optional<std::string> why_not_solid(const Vec3& moments, const Vec3& products);

}  // namespace hal::files::description
