#pragma once

#include <span>
#include <vector>

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `controller:` of a group: `program`, `processes`, `parameters` for all its agents and
/// `overrides` for some. Parameters stay text; the controller's plug-in checks them.
void controller_keys(Fields& io, Group& group, std::span<agents::AgentConfig> agents);

}  // namespace sim::scenario
