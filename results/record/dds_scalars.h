#pragma once

#include <vector>

#include "results/record/scalars.h"

namespace results::record {

/// The scalars of DDS topics and of the use of the air by purpose, of runs in which an agent has a
/// network.
std::vector<ScalarKind> dds_scalars();

}  // namespace results::record
