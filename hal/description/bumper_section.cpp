#include "hal/description/bumper_section.h"

#include "hal/description/mount_section.h"

namespace hal::description {

void read(config::Mapping& in, devices::Bumper& bumper) { read_name(in, bumper.mount); }

void write(config::Writer& out, const devices::Bumper& bumper) { write_name(out, bumper.mount); }

}  // namespace hal::description
