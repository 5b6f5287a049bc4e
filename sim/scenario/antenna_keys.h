#pragma once

#include <optional>

#include "sim/radio/channel/antenna.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {

/// The key `antenna` of a radio: gain by direction. A table is kept and written with its rows, so
/// that a resolved scenario does not need the file.
void antenna_key(Fields& io, radio::AntennaConfig& antenna);

/// The same of some agents.
void antenna_key(Fields& io, std::optional<radio::AntennaConfig>& antenna);

}  // namespace sim::scenario
