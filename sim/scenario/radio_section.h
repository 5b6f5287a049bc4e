#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "sim/radio/radio_config.h"

namespace sim::scenario {

/// `radio:` of a scenario, or a radio file: `profile` and those keys that the profile uses. A key
/// of another profile is a mistake that names the profile.
radio::RadioConfig read_radio(hal::config::Mapping in);
void write_radio(hal::config::Writer& out, const radio::RadioConfig& config);

/// `radio:` of a group of agents: what their radios have of their own.
struct StationRadio {
  std::optional<hal::Milliwatts> tx_power{};
  std::optional<hal::Metres> antenna_height{};
  std::optional<std::vector<std::string>> access_points{};
};
StationRadio read_station(hal::config::Mapping in, const radio::RadioConfig& config);
void write_station(hal::config::Writer& out, const StationRadio& station);

}  // namespace sim::scenario
