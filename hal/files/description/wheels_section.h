#pragma once

#include <vector>

#include "hal/files/description/fields.h"
#include "hal/node/devices/wheel.h"

namespace hal::files::description {

/// `wheels:` of a robot: `wheel`, what all driven wheels have in common, and `joints`, one per
/// wheel, which may deviate. Casters take nothing from `wheel`.
void wheels_keys(Fields& io, std::vector<node::devices::Wheel>& wheels);

}  // namespace hal::files::description
