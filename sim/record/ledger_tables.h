#pragma once

#include <vector>

#include "sim/record/schema.h"

namespace sim::record {

/// Of the tables of schema.h those of AirLog, and the views of them.
std::vector<Table> ledger_tables();

}  // namespace sim::record
