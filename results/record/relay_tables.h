#pragma once

#include <vector>

#include "results/record/schema.h"

namespace results::record {

/// Tables of what access points pass on: relays, relay_queues.
std::vector<Table> relay_tables();

}  // namespace results::record
