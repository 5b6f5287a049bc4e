#pragma once

#include <csignal>

namespace programs::waits {

/// While this lives, the run can end waits of the calling thread.
class OpenToEnd {
 public:
  OpenToEnd();
  ~OpenToEnd();
  OpenToEnd(const OpenToEnd&) = delete;
  OpenToEnd& operator=(const OpenToEnd&) = delete;

 private:
  sigset_t before_{};
};

/// A signal may have been sent. What it does, the end of a process or a handler, is over before
/// anybody goes on, this thread included: the run looks at all threads then, those that are parked,
/// too. @return the status, as it is.
long told(long status);

}  // namespace programs::waits
