#pragma once

#include "sim/radio/loss_config.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `loss` of a radio: frames that get lost beyond what the physics say.
void keys_of(Fields& io, radio::LossConfig& loss);

/// After the agents have been read: `links` must name some of them.
/// @param radio  the mapping whose `loss` was read.
void check_loss_names(Mapping radio, const Scenario& scenario);

}  // namespace sim::scenario
