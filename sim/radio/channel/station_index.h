#pragma once

#include "sim/core/cell_grid.h"

namespace sim::radio {

/// Number of a station in ascending order of addresses: 0, 1, 2, …
using StationIndex = CellGrid::Member;

}  // namespace sim::radio
