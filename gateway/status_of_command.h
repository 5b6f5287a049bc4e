#pragma once

#include <functional>

namespace gateway {

/// Runs what a command line asks for: what it throws is said on standard error and becomes the exit
/// status of the program (ExitStatus), the same in all programs.
/// @param command  its result is the status if it throws nothing.
int status_of_command(const std::function<int()>& command);

}  // namespace gateway
