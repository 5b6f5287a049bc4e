#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "sim/radio/radio_config.h"

namespace sim::scenario {

/// `radio:` of a scenario, or a radio file: `profile` and those keys that the profile uses. A key
/// of another profile is a mistake that names the profile.
radio::RadioConfig read_radio(hal::config::Mapping in);
void write_radio(hal::config::Writer& out, const radio::RadioConfig& config);

}  // namespace sim::scenario
