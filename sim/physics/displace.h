#pragma once

#include "hal/types/geometry.h"
#include "sim/core/ground.h"
#include "sim/physics/object.h"

namespace sim::physics {

/// Puts an object's bodies somewhere else, awake and at rest: as they are to each other, and with
/// the main one upright on the ground. A robot keeps its command.
/// @param pose  m, rad, world frame, of the origin
void displace(Object& object, const hal::Pose2& pose, const Ground& ground);

}  // namespace sim::physics
