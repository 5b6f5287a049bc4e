#pragma once

#include <string>

#include "hal/api/robot.h"
#include "hal/exchange/session.h"

namespace hal::runtime {

/// What the motors can do of a body velocity: the greatest multiple <= 1 of it that keeps every
/// wheel within its limit. @pre limits has wheels; twist is finite.
Drive saturate(const exchange::DriveLimits& limits, const Twist2& twist);

/// What is wrong with a body velocity, or with wheel speeds [rad/s]: the field and its value.
/// Empty: nothing.
std::string mistake_in(const Twist2& twist);
std::string mistake_in(const exchange::DriveLimits& limits, std::span<const double> wheel_speeds);

}  // namespace hal::runtime
