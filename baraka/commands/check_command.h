#pragma once

#include <string>
#include <vector>

#include "baraka/run/check/check_controllers.h"

namespace baraka::commands {

/// What the command line of `baraka check` says.
struct CheckOptions {
  std::vector<std::string> files;
  std::vector<std::string> overrides;  ///< --set
  run::check::RunMode mode;            ///< In which a scenario is to be run.
  std::string kind;                    ///< Of file_kinds(); empty: recognised by its keys.
};

/// Prints every mistake in files of any kind; "ok" for those without. @return exit status.
int check(const CheckOptions& options);

}  // namespace baraka::commands
