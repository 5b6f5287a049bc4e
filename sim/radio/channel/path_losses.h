#pragma once

#include <memory>

#include "sim/core/ground.h"
#include "sim/radio/channel/path_loss.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// The path loss of one entry of a chain. @param air  the rest of what is said of propagation.
/// @param ground  outlives it.
std::unique_ptr<const PathLoss> path_loss(const PathLossConfig& config,
                                          const PropagationConfig& air, const Ground& ground);

}  // namespace sim::radio
