#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `agents:` of a scenario: groups in order of declaration, each with the pattern of its names, a
/// body, where its agents stand, and a controller. Fills in groups and agents; addresses count from
/// 1, or from a group's `address`.
void read_agents(hal::config::Mapping in, Scenario& scenario);
void write_agents(hal::config::Writer& out, const Scenario& scenario);

}  // namespace sim::scenario
