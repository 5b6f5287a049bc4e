#pragma once

#include <span>

#include "hal/types/geometry.h"

namespace controllers {

/// Direction in which to drive to pass agents that stand in the way. A mote is 5 cm wide and fits
/// between the beams of infrared sensors, so their known positions are used instead.
///
/// @param way        unit vector, body frame.
/// @param localised  triples (address, x, y), body frame, m: channel "localisation".
/// @param clearance  m to keep between this robot's centre and that of another agent.
/// @return unit vector; `way` itself if no agent is in it within kLookAhead.
hal::Vec2 way_past(hal::Vec2 way, std::span<const double> localised, double clearance);

inline constexpr double kLookAhead = 1.5;  // m

}  // namespace controllers
