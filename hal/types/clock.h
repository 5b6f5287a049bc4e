#pragma once

#include <poll.h>

#include <span>

#include "hal/types/time.h"

namespace hal {

/// A clock of the world outside a simulation, and the waiting by it: one of the computer, or in
/// tests one by which time passes only while somebody waits.
class Clock {
 public:
  virtual ~Clock() = default;

  /// Since some moment; never jumps, never goes back. Any thread.
  virtual Time now() const = 0;

  /// Waits until one of the descriptors is readable, or has failed, at most so long. What is there
  /// is marked as by poll(2), which see; a negative descriptor is skipped.
  /// @return how many are marked. An interrupting signal handler counts as time that has passed.
  virtual int wait(std::span<pollfd> descriptors, Duration at_most) = 0;
};

/// Clock::wait() by the clock of the computer. @param at_most  Duration::max(): for ever.
int poll_for(std::span<pollfd> descriptors, Duration at_most);

}  // namespace hal
