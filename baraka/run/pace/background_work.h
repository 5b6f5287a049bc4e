#pragma once

#include <optional>

#include "hal/types/time.h"

namespace baraka::run::pace {

/// What goes on in the background of a run in real time, and is attended to while the run waits:
/// programs. On the run's thread.
class BackgroundWork {
 public:
  virtual ~BackgroundWork() = default;

  /// Readable when there is something to attend to.
  virtual int descriptor() const = 0;

  /// Does what is due. @param now  simulated time. @throws std::runtime_error  the run cannot go
  /// on.
  virtual void attend(hal::Time now) = 0;

  /// When the next is due, simulated time, whatever happens; none: never.
  virtual std::optional<hal::Time> next() const = 0;

  /// No wait is longer, wall time.
  virtual hal::Duration longest_wait() const = 0;

  /// A wait ends so much early, and the rest passes in looking again and again: a sleeper is woken
  /// that late. Wall time.
  virtual hal::Duration spin() const = 0;

  /// Right before and after each wait that may last.
  virtual void before_wait() = 0;
  virtual void after_wait() = 0;
};

}  // namespace baraka::run::pace
