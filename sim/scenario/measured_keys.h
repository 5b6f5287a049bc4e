#pragma once

#include "sim/radio/channel/measured.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// The keys of the law `measured`. The losses are kept and written, so that a resolved scenario
/// does not need the file, and one with other losses is another scenario.
void keys_of(Fields& io, radio::MeasuredConfig& c);

/// Notes stations that do not exist, and pairs on one channel without a loss and a law for it.
/// @param in  the scenario.
void check_measured(Mapping& in, const Scenario& scenario, const radio::MeasuredConfig& c);

}  // namespace sim::scenario
