#pragma once

#include <vector>

#include "results/record/schema.h"

namespace results::record {

/// Of the tables of schema.h those of AirLog, and the views of them.
std::vector<Table> ledger_tables();

}  // namespace results::record
