#pragma once

#include <optional>

#include "programs/models/robot.h"

namespace programs::models {

/// Acceleration and deceleration at which no wheel leaves the ground, with a quarter to spare; URDF
/// has none of its own, and the simulator's default of 1.5 m/s^2 tips some robots over.
/// @return nullopt: the default does not, or the robot does not stand on its wheels at all.
std::optional<double> gentle_acceleration(const Robot& robot);

}  // namespace programs::models
