#pragma once

#include <vector>

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "sim/radio/path_loss_config.h"

namespace sim::scenario {

/// `propagation` of a radio: what the way does to a power, one after the other.
/// @return `otherwise` if the file says nothing.
std::vector<radio::PathLossConfig> read_propagation(hal::config::Mapping& in,
                                                    std::vector<radio::PathLossConfig> otherwise);
void write_propagation(hal::config::Writer& out, const std::vector<radio::PathLossConfig>& chain);

}  // namespace sim::scenario
