#pragma once

#include <vector>

#include "hal/files/description/fields.h"
#include "hal/node/devices/wheel.h"

namespace hal::files::description {

/// `wheels:` of a robot: `wheel`, the common properties of all driven wheels, and `joints`, one per
/// wheel, which may override them. Casters take nothing from `wheel`.
void wheels_keys(Fields& io, std::vector<node::devices::Wheel>& wheels);

}  // namespace hal::files::description
