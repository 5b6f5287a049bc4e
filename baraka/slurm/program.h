#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hal/types/result.h"
#include "hal/types/time.h"

namespace baraka::slurm {

/// What a program printed, and how it ended.
struct Printed {
  int status = 0;  ///< Exit status; 128 + signal if a signal killed it.
  std::string out, err;
  /// The last line of err that says anything, else the first of out, else how it ended.
  std::string last_error() const;
  /// The last three lines of err in one, else as last_error().
  std::string last_errors() const;
};

/// Runs a program of PATH to its end, in a process group of its own, so that Ctrl-C does not reach
/// it, with nothing to read. Killed after `longest`, and when this process dies.
/// Errors: kNotAvailable, there is no such program, or it cannot be started; kTimeout.
/// @param give_up  asked ten times a second, with what was printed so far: whether not to wait
///   any longer, which is as if `longest` had passed. Empty: never.
hal::Result<Printed> run_program(const std::vector<std::string>& command, hal::Duration longest,
                                 const std::function<bool(const Printed&)>& give_up = {});

}  // namespace baraka::slurm
