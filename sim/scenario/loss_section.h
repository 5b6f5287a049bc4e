#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "sim/radio/loss_config.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `loss` of a radio: frames that get lost beyond what the physics say.
radio::LossConfig read_loss(hal::config::Mapping in);
void write_loss(hal::config::Writer& out, const radio::LossConfig& loss);

/// After the agents have been read: `links` must name some of them.
/// @param radio  the mapping whose `loss` was read.
void check_loss_names(hal::config::Mapping radio, const Scenario& scenario);

}  // namespace sim::scenario
