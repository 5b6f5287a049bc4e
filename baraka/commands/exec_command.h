#pragma once

#include <string>
#include <vector>

namespace baraka::commands {

/// What `baraka exec` is asked for.
struct ExecOptions {
  std::string agent;
  std::string run;                   ///< Results folder; empty: that of the only run under way.
  std::vector<std::string> command;  ///< Empty: the user's shell.
};

/// Becomes a program inside an agent of a run that is under way, with this terminal and that run's
/// clock. Does not return. @throws UsageError  no such run, or which one is not clear.
/// @throws std::runtime_error  baraka-holder cannot be started.
[[noreturn]] void exec_inside(const ExecOptions& options);

}  // namespace baraka::commands
