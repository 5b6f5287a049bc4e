#pragma once

#include <string>
#include <vector>

#include "baraka/run/check/check_controllers.h"

namespace baraka::commands {

/// The command line of `baraka check`.
struct CheckOptions {
  std::vector<std::string> files;
  std::vector<std::string> overrides;  ///< Values of --set.
  run::check::RunMode mode;            ///< Mode in which a scenario would be run.
  std::string kind;                    ///< Name of a FileKind; empty: recognised by the keys.
};

/// Prints every mistake in the files, or "ok" for a file without mistakes. @return exit status.
int check(const CheckOptions& options);

}  // namespace baraka::commands
