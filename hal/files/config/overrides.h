#pragma once

#include <string>
#include <vector>

#include "hal/files/config/node.h"
#include "hal/files/config/problems.h"

namespace hal::files::config {

/// The overrides "dotted.path=value" of a command line as one mapping; later ones take precedence.
/// An override that cannot be read is recorded as a problem and omitted.
Node read_overrides(const std::vector<std::string>& overrides, Problems& problems);

}  // namespace hal::files::config
