#pragma once

#include "hal/api/robot.h"
#include "hal/exchange/session.h"

namespace hal::runtime {

/// What the wheels can do of a body velocity: the feasible motion nearest to it, scaled by the
/// greatest factor <= 1 that keeps every wheel within its limit. @pre limits has wheels; wanted is
/// finite.
Drive saturate(const exchange::DriveLimits& limits, const Twist2& wanted);

}  // namespace hal::runtime
