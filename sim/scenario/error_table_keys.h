#pragma once

#include "sim/radio/phy/error_table.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {

/// The key `error_table`: a file with packet error rates, or its rows. The rows are kept and
/// written, so that a resolved scenario does not need the file.
void error_table_key(Fields& io, radio::ErrorTable& table);

}  // namespace sim::scenario
