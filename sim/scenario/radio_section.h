#pragma once

#include <string>
#include <vector>

#include "sim/radio/radio_config.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {

/// `radio:` of a scenario, or a radio file: `profile` and those keys that the profile uses. A key
/// of another profile is a mistake that names the profile.
void keys_of(Fields& io, radio::RadioConfig& config);

/// The profiles that have something, by name.
std::vector<std::string> profiles_with(bool (*has)(const radio::RadioConfig& config));

/// A radio file.
radio::RadioConfig read_radio(Mapping in);

}  // namespace sim::scenario
