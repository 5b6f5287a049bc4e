#pragma once

#include <fcntl.h>

#include <cerrno>

#include "programs/preload/intercepted.h"

namespace programs::waits {

/// While this lives, calls for a descriptor say EAGAIN in place of waiting. Others that have the
/// same open file do not see it: one thread of an agent runs at a time.
class NonBlocking {
 public:
  explicit NonBlocking(int descriptor)
      : descriptor_(descriptor), flags_(BARAKA_NEXT_QUIET(fcntl64)(descriptor, F_GETFL)) {
    if (changes()) BARAKA_NEXT_QUIET(fcntl64)(descriptor_, F_SETFL, flags_ | O_NONBLOCK);
  }
  ~NonBlocking() {
    const int kept = errno;
    if (changes()) BARAKA_NEXT_QUIET(fcntl64)(descriptor_, F_SETFL, flags_);
    errno = kept;
  }
  NonBlocking(const NonBlocking&) = delete;
  NonBlocking& operator=(const NonBlocking&) = delete;

 private:
  bool changes() const { return flags_ >= 0 && (flags_ & O_NONBLOCK) == 0; }

  int descriptor_, flags_;
};

}  // namespace programs::waits
