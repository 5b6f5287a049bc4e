#pragma once

#include <vector>

#include "hal/files/config/mapping.h"
#include "hal/files/config/writer.h"
#include "hal/node/devices/wheel.h"

namespace hal::files::description {

/// `wheels:` of a robot: `wheel`, what all driven wheels have in common, and `joints`, one per
/// wheel, which may deviate. Casters take nothing from `wheel`.
std::vector<node::devices::Wheel> read_wheels(config::Mapping in);
void write_wheels(config::Writer& out, std::vector<node::devices::Wheel> wheels);

}  // namespace hal::files::description
