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

/// A signal may have been sent: handlers may run now in threads that are parked, so that the run is
/// to look at these, too. @return the status, as it is.
long told(long status);

}  // namespace programs::waits
