#pragma once

namespace gateway::app {

/// Exit status of the program.
enum ExitStatus : unsigned char {
  kDone = 0,
  kRunFailed = 1,
  kUsage = 2,  ///< The command line or a file is wrong.
  kExpectationNotMet = 3,
  kInterrupted = 130,
};

}  // namespace gateway::app
