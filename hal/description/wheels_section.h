#pragma once

#include <vector>

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/devices/wheel.h"

namespace hal::description {

/// `wheels:` of a robot: `wheel`, what all driven wheels have in common, and `joints`, one per
/// wheel, which may deviate. Casters take nothing from `wheel`.
std::vector<devices::Wheel> read_wheels(config::Mapping in);
void write_wheels(config::Writer& out, const std::vector<devices::Wheel>& wheels);

}  // namespace hal::description
