#pragma once

#include "sim/radio/channel/loss_config.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `loss` of a radio: random loss of frames that would otherwise be received.
void keys_of(Fields& io, radio::LossConfig& loss);

/// Checks that `links` names agents; call after the agents have been read.
/// @param radio  the mapping whose `loss` was read.
void check_loss_names(Mapping radio, const Scenario& scenario);

}  // namespace sim::scenario
