#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "sim/radio/bss_config.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `bss` of a radio: infrastructure mode, its access points and how stations use them.
void read_bss(hal::config::Mapping in, radio::BssConfig& config);
void write_bss(hal::config::Writer& out, const radio::BssConfig& config);

/// `bss` of the radio of a group of agents: which access points they may use.
/// @return none: the file says nothing; empty: they are in an ad hoc network.
std::optional<std::vector<std::string>> read_own_access_points(hal::config::Mapping in);
void write_own_access_points(hal::config::Writer& out,
                             const std::optional<std::vector<std::string>>& names);

/// Notes the access points that are no agents, wherever they stand.
/// @param in  the scenario, whose `radio` and `agents` have been read.
void check_access_points(hal::config::Mapping& in, const Scenario& scenario);

}  // namespace sim::scenario
