#pragma once

#include "hal/files/description/fields.h"

namespace hal::files::description {

/// Position and direction of a part on the body: `position: [x, y]`, or `distance` and `bearing`
/// from the body's origin, which are never written.
/// @param heading  key of the angle; absent: the bearing of the position.
void mounting_keys(Fields& io, const Key& heading, Vec2& position, double& angle);

}  // namespace hal::files::description
