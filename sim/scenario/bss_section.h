#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal/files/config/mapping.h"
#include "sim/radio/infrastructure/bss_config.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `bss` of a radio: infrastructure mode, its access points and how stations use them.
void keys_of(Fields& io, radio::BssConfig& config);

/// `bss` of the radio of a group of agents: the access points that they may use. nullopt: not
/// given; empty: they are in an ad hoc network.
void own_access_points_key(Fields& io, std::optional<std::vector<std::string>>& names);

/// Notes every listed access point that is not an agent.
/// @param in  the scenario, whose `radio` and `agents` have been read.
void check_access_points(hal::files::config::Mapping& in, const Scenario& scenario);

}  // namespace sim::scenario
