#pragma once

#include <vector>

#include "results/record/schema.h"

namespace results::record {

/// What is looked at of agents while they move and talk, a row for each change: routes, readings,
/// queues, contacts.
std::vector<Table> look_tables();

/// Frames one by one, and how they ended.
std::vector<Table> frame_tables();

}  // namespace results::record
