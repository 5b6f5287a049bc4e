#pragma once

#include <vector>

#include "results/record/schema.h"

namespace results::record {

/// The tables for what `record: {observables: ...}` asks for.
std::vector<Table> observable_tables();

}  // namespace results::record
