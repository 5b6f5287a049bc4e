#pragma once

#include <string>
#include <vector>

#include "hal/files/config/node.h"
#include "hal/files/config/problems.h"

namespace hal::files::config {

/// The overrides "dotted.path=value" of a command line as one mapping, later ones over earlier
/// ones. What cannot be read is noted and left out.
Node read_overrides(const std::vector<std::string>& overrides, Problems& problems);

}  // namespace hal::files::config
