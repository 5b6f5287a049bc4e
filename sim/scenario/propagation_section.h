#pragma once

#include <vector>

#include "sim/radio/channel/path_loss_config.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {

/// `propagation` of a radio: what the way does to a power, one after the other. The chain stays as
/// it is if the file says nothing.
void chain_keys(Fields& io, std::vector<radio::PathLossConfig>& chain);

}  // namespace sim::scenario
