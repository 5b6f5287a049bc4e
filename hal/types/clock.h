#pragma once

#include <poll.h>

#include <span>

#include "hal/types/time.h"

namespace hal {

/// A clock outside the simulation, with a wait: a clock of the computer, or in tests a clock that
/// advances only during wait().
class Clock {
 public:
  virtual ~Clock() = default;

  /// Time since an unspecified moment; monotonic, without jumps. Any thread.
  virtual Time now() const = 0;

  /// Waits until a descriptor is readable or has failed, or `at_most` has passed. Sets `revents` as
  /// poll(2) does; negative descriptors are skipped.
  /// @return number of descriptors with events; 0 after a time-out or if a signal handler
  /// interrupted the wait.
  virtual int wait(std::span<pollfd> descriptors, Duration at_most) = 0;
};

/// Clock::wait() by the clock of the computer. @param at_most  Duration::max(): for ever.
int poll_for(std::span<pollfd> descriptors, Duration at_most);

}  // namespace hal
