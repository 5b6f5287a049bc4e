#pragma once

#include "hal/types/geometry.h"
#include "sim/core/ground.h"
#include "sim/physics/object.h"

namespace sim::physics {

/// Places an object at a pose, awake and at rest, with the main body upright on the ground and the
/// other bodies in the same relative poses. The command of a robot is kept.
/// @param pose  m, rad, world frame, of the origin
void displace(Object& object, const hal::Pose2& pose, const Ground& ground);

}  // namespace sim::physics
