#pragma once

#include "hal/files/description/fields.h"
#include "hal/node/devices/mount.h"

namespace hal::files::description {

/// `name` of a sensor that has no place of its own.
void name_key(Fields& io, node::devices::Mount& mount);

/// `name`, `position` and `heading` of a sensor.
void keys_of(Fields& io, node::devices::Mount& mount);

}  // namespace hal::files::description
