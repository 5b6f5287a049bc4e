#pragma once

#include <memory>

#include "sim/radio/path_loss.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// The path loss of one entry of a chain. @param air  the rest of what is said of propagation.
std::unique_ptr<const PathLoss> path_loss(const PathLossConfig& config,
                                          const PropagationConfig& air);

}  // namespace sim::radio
