#pragma once

#include <functional>

namespace gateway::process {

/// Runs a command: an exception is reported on standard error and becomes the exit status of the
/// program (ExitStatus), the same in all programs.
/// @param command  its result is the status if it does not throw.
int status_of_command(const std::function<int()>& command);

}  // namespace gateway::process
