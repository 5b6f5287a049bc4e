#pragma once

#include <stdexcept>

namespace gateway::app {

/// Exit status of the program.
enum ExitStatus : int {
  kDone = 0,
  kRunFailed = 1,
  kUsage = 2,  ///< The command line or a file is wrong.
  kExpectationNotMet = 3,
  kInterrupted = 130,
};

/// Something the user has to change before the run can start.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace gateway::app
