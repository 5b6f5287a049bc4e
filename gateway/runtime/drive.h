#pragma once

#include "hal/api/robot.h"
#include "hal/node/exchange/session.h"

namespace gateway::runtime {

/// The part of a body velocity that the wheels can produce: the nearest feasible motion, scaled by
/// the greatest factor <= 1 that keeps every wheel within its limit. @pre limits has wheels; wanted
/// is finite.
hal::Drive saturate(const hal::node::exchange::DriveLimits& limits, const hal::Twist2& wanted);

}  // namespace gateway::runtime
