#pragma once

#include <vector>

#include "sim/record/schema.h"

namespace sim::record {

/// Tables of what access points pass on: relays, relay_queues.
std::vector<Table> relay_tables();

}  // namespace sim::record
