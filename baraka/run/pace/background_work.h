#pragma once

#include <optional>

#include "hal/types/time.h"

namespace baraka::run::pace {

/// Work in the background of a real-time run (the programs), done on the run's thread while the run
/// waits.
class BackgroundWork {
 public:
  virtual ~BackgroundWork() = default;

  /// A descriptor that is readable when there is work.
  virtual int descriptor() const = 0;

  /// Does the work that is due. @param now  simulated time.
  /// @throws std::runtime_error  the run cannot go on.
  virtual void attend(hal::Time now) = 0;

  /// Simulated time at which work is due even if the descriptor is not readable; none: never.
  virtual std::optional<hal::Time> next() const = 0;

  /// Longest single wait, wall time.
  virtual hal::Duration longest_wait() const = 0;

  /// A wait ends this much early, because a sleeping thread is woken late; the rest is spent
  /// polling. Wall time.
  virtual hal::Duration spin() const = 0;

  /// Called directly before and after each wait that may sleep.
  virtual void before_wait() = 0;
  virtual void after_wait() = 0;
};

}  // namespace baraka::run::pace
