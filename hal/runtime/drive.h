#pragma once

#include <string>

#include "hal/api/robot.h"
#include "hal/exchange/session.h"

namespace hal::runtime {

/// What the wheels can do of a body velocity: the feasible motion nearest to it, scaled by the
/// greatest factor <= 1 that keeps every wheel within its limit. @pre limits has wheels; wanted is
/// finite.
Drive saturate(const exchange::DriveLimits& limits, const Twist2& wanted);

/// What is wrong with a body velocity, or with wheel speeds [rad/s]: the field and its value.
/// Empty: nothing.
std::string mistake_in(const Twist2& twist);
std::string mistake_in(const exchange::DriveLimits& limits, std::span<const double> wheel_speeds);

}  // namespace hal::runtime
