#pragma once

#include <string>

namespace baraka::commands {

/// The command line of `baraka diff`.
struct DiffOptions {
  std::string folder, other;  ///< Folders of the results of runs.
};

/// Exit status of `baraka diff` if the same did not happen in both runs, as of diff(1).
inline constexpr int kDifferent = 1;

/// Prints how two runs compare, as lines "name: value" and "name: value | other value", and the
/// first difference between what happened in them.
/// @return kDone or kDifferent. @throws UsageError  a folder has no result, or it cannot be read.
int diff(const DiffOptions& options);

}  // namespace baraka::commands
