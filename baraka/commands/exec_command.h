#pragma once

#include <string>
#include <vector>

namespace baraka::commands {

/// The command line of `baraka exec`.
struct ExecOptions {
  std::string agent;
  std::string run;                   ///< Results folder; empty: the only run under way.
  std::vector<std::string> command;  ///< Empty: the user's shell.
};

/// Replaces this process by a program inside an agent of a running simulation, with this terminal
/// and the clock of that run. Does not return.
/// @throws UsageError  there is no such run, or several runs are under way and none is named.
/// @throws std::runtime_error  baraka-holder cannot be started.
[[noreturn]] void exec_inside(const ExecOptions& options);

}  // namespace baraka::commands
