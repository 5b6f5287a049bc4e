#pragma once

#include <string>
#include <vector>

#include "hal/config/node.h"
#include "hal/config/problems.h"

namespace hal::config {

/// The overrides "dotted.path=value" of a command line as one mapping, later ones over earlier
/// ones. What cannot be read is noted and left out.
Node read_overrides(const std::vector<std::string>& overrides, Problems& problems);

}  // namespace hal::config
