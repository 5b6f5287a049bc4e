#pragma once

#include <span>

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `controller:` of a group: `program`, `processes`, `parameters` for all its agents and
/// `overrides` for some. Parameters stay text; the controller's plug-in judges them.
void read_controller(hal::config::Mapping in, Group& group, std::span<agents::AgentConfig> agents);
void write_controller(hal::config::Writer& out, const Group& group,
                      std::span<const agents::AgentConfig> agents);

}  // namespace sim::scenario
