#pragma once

#include <vector>

#include "results/record/schema.h"

namespace results::record {

/// The tables that the Recorder writes itself: what was run, with which agents, and the result.
std::vector<Table> run_tables();
std::vector<Table> countable_tables();
std::vector<Table> fingerprint_tables();

}  // namespace results::record
