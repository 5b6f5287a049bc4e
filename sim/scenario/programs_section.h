#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `programs:` of a group whose agents have a network.
void read_programs(hal::config::Mapping& in, Group& group);
void write_programs(hal::config::Writer& out, const Group& group);

/// Notes log files that two would write. @param in  the top level.
void check_logs(hal::config::Mapping& in, const Scenario& scenario);

}  // namespace sim::scenario
