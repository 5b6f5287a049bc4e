#pragma once

#include "hal/api/robot.h"
#include "hal/exchange/session.h"

namespace hal::runtime {

/// What the motors can do of a body velocity: the greatest multiple <= 1 of it that keeps every
/// wheel within its limit. @pre limits has wheels; twist is finite.
Drive saturate(const exchange::DriveLimits& limits, const Twist2& twist);

}  // namespace hal::runtime
