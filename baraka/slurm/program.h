#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hal/types/result.h"
#include "hal/types/time.h"

namespace baraka::slurm {

/// The output of a program and how it ended.
struct Printed {
  int status = 0;  ///< Exit status; 128 + signal if a signal killed it.
  std::string out, err;
  /// The last non-empty line of err, otherwise the first line of out, otherwise how it ended.
  std::string last_error() const;
  /// The last three lines of err, joined; otherwise as last_error().
  std::string last_errors() const;
};

/// Runs a program, found in PATH, to its end, without input and in a process group of its own, so
/// that Ctrl-C does not reach it. The program is killed after `longest`, and when this process
/// dies. Errors: kNotAvailable: there is no such program, or it cannot be started; kTimeout.
/// @param give_up  called ten times a second with the output so far; true: stop waiting, as if
///   `longest` had passed. Empty: never.
hal::Result<Printed> run_program(const std::vector<std::string>& command, hal::Duration longest,
                                 const std::function<bool(const Printed&)>& give_up = {});

}  // namespace baraka::slurm
