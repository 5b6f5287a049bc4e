#pragma once

#include "hal/files/description/fields.h"

namespace hal::files::description {

/// Where a part sits on the body and which way it points: `position: [x, y]`, or `distance` and
/// `bearing` from the body's origin, which are not written.
/// @param heading  key of the angle; absent: the bearing of the position.
/// @param position  m, body frame. @param angle  rad, body frame.
void mounting_keys(Fields& io, const Key& heading, Vec2& position, double& angle);

}  // namespace hal::files::description
