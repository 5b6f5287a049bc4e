#pragma once

#include "gateway/run/run_command.h"

namespace gateway {

/// Runs a scenario `options.replications` times, `options.jobs` at a time, each in a process and a
/// folder of its own; number k has the scenario's seed + k - 1. Those that have ended before, with
/// the same scenario in the same folder, are not run again; those that failed or were cut short
/// are. Prints how they ended, as "key: value" lines on standard output.
/// @return exit status: of the worst. @throws hal::config::ConfigErrors, std::runtime_error
int run_replications(const RunOptions& options);

}  // namespace gateway
