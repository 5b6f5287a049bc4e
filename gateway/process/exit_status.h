#pragma once

#include <stdexcept>

namespace gateway::process {

/// Exit status of the program.
enum ExitStatus : unsigned char {
  kDone = 0,
  kRunFailed = 1,
  kUsage = 2,  ///< The command line or a file is wrong.
  kExpectationNotMet = 3,
  kInterrupted = 130,
};

/// The command line asks for something impossible.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The user has interrupted an operation that cannot be stopped in another way.
struct Interrupted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace gateway::process
