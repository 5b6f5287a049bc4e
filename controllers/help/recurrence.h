#pragma once

#include <cmath>
#include <optional>

#include "hal/types/time.h"

namespace controllers {

/// Times at which something falls due: a first one, and then one every period.
class Recurrence {
 public:
  /// @param first, every  s; infinity: never, and never again.
  Recurrence(double first, double every) {
    if (std::isfinite(first)) next_ = hal::Time{hal::from_seconds(first)};
    if (std::isfinite(every)) every_ = hal::from_seconds(every);
  }

  /// Whether it falls due by `now`; then the next one is due whole periods after this one was, at
  /// the first such time that lies ahead. Of several that were missed, as by a controller that is
  /// restarted, one falls due.
  bool falls_due(hal::Time now) {
    if (!next_ || now < *next_) return false;
    const hal::Time due = *next_;
    next_.reset();
    if (every_) next_ = due + *every_ * ((now - due) / *every_ + 1);
    return true;
  }

 private:
  std::optional<hal::Time> next_;  ///< Nothing: none any more.
  std::optional<hal::Duration> every_;
};

}  // namespace controllers
