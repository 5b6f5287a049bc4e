#pragma once

#include <span>

#include "hal/types/geometry.h"

namespace controllers {

/// The way to drive so as to pass beside agents that stand in it. A mote is 5 cm wide: it fits
/// between the beams of infrared sensors, so a robot that knows where the motes are uses that.
///
/// @param way        unit vector, body frame.
/// @param localised  triples (address, x, y), body frame, m: channel "localisation".
/// @param clearance  m to keep between this robot's centre and that of another agent.
/// @return unit vector; `way` itself if nobody is in it within kLookAhead.
hal::Vec2 way_past(hal::Vec2 way, std::span<const double> localised, double clearance);

inline constexpr double kLookAhead = 1.5;  // m

}  // namespace controllers
