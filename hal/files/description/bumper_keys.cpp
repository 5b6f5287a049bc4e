#include "hal/files/description/sensor_keys.h"

namespace hal::files::description {

void keys_of(Fields& io, node::devices::Bumper& bumper) { name_key(io, bumper.mount); }

}  // namespace hal::files::description
