#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/devices/mount.h"

namespace hal::description {

/// `name` of a sensor that has no place of its own.
void read_name(config::Mapping& in, devices::Mount& mount);
void write_name(config::Writer& out, const devices::Mount& mount);

/// `name`, `position` and `heading` of a sensor; what is absent keeps its value.
void read_mount(config::Mapping& in, devices::Mount& mount);
void write_mount(config::Writer& out, const devices::Mount& mount);

}  // namespace hal::description
