#pragma once

#include <vector>

#include "results/record/schema.h"

namespace results::record {

/// The tables of AirLog and their views, for schema.h.
std::vector<Table> ledger_tables();

}  // namespace results::record
