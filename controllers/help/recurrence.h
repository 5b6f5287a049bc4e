#pragma once

#include <cmath>
#include <optional>

#include "hal/types/time.h"

namespace controllers {

/// Periodic due times: a first one, and then one every period.
class Recurrence {
 public:
  /// @param first, every  s; infinity: never, and not periodic.
  Recurrence(double first, double every) {
    if (std::isfinite(first)) next_ = hal::Time{hal::from_seconds(first)};
    if (std::isfinite(every)) every_ = hal::from_seconds(every);
  }

  /// Whether a due time has been reached by `now`. The next one is then a whole number of periods
  /// later, the first that is after `now`: if several were missed, for example because the
  /// controller was restarted, only one falls due.
  bool falls_due(hal::Time now) {
    if (!next_ || now < *next_) return false;
    const hal::Time due = *next_;
    next_.reset();
    if (every_) next_ = due + *every_ * ((now - due) / *every_ + 1);
    return true;
  }

 private:
  std::optional<hal::Time> next_;  ///< nullopt: no more due times.
  std::optional<hal::Duration> every_;
};

}  // namespace controllers
