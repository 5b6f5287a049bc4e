#pragma once

#include "hal/types/time.h"

namespace sim::radio {

/// Network allocation vector: the time until which other stations have reserved the medium (IEEE
/// Std 802.11-2016, 10.3.2.4).
class Nav {
 public:
  bool is_set(hal::Time now) const { return now < until_; }
  hal::Time until() const { return until_; }

  /// @return whether the reservation was extended.
  bool extend(hal::Time until) {
    if (until <= until_) return false;
    until_ = until;
    return true;
  }
  void reset() { until_ = {}; }

 private:
  hal::Time until_{};
};

}  // namespace sim::radio
