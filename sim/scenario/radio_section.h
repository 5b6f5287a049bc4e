#pragma once

#include <string>
#include <vector>

#include "sim/radio/radio_config.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {

/// `radio:` of a scenario, or a radio file: `profile` and the keys that the profile uses. A key of
/// another profile is a mistake; the message names the profiles that use it.
void keys_of(Fields& io, radio::RadioConfig& config);

/// Names of the profiles for which `has` is true.
std::vector<std::string> profiles_with(bool (*has)(const radio::RadioConfig& config));

/// Reads a radio file.
radio::RadioConfig read_radio(Mapping in);

}  // namespace sim::scenario
