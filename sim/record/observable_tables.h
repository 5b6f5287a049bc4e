#pragma once

#include <vector>

#include "sim/record/schema.h"

namespace sim::record {

/// The tables of what `record: {observables: ...}` asks for.
std::vector<Table> observable_tables();

}  // namespace sim::record
